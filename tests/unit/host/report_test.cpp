// SPDX-License-Identifier: Apache-2.0
// What `penduline report` makes of samples and estimates, and how its page takes it in.
#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "host/report/recorded_time.hpp"
#include "host/report/report_page.hpp"
#include "host/report/report_points.hpp"
#include "host/report/report_rows.hpp"
#include "tests/unit/host/rig_text.hpp"

namespace penduline::test {
namespace {

constexpr std::int64_t kPeriodUs = 50'000;
constexpr Acquisition<double> kAcquisition{.rate_hz = 20};

/// The sample of a number since the board's start; its signal tells the number.
Sample sample(std::int64_t number, Flags flags = 0) {
  Sample made{
      .seq = static_cast<std::uint64_t>(number), .t_us = (number + 1) * kPeriodUs, .flags = flags};
  made.readings[0] = made.readings[1] = {.on = static_cast<std::int32_t>(1000 * (number + 1))};
  return made;
}

Estimate<double> estimate(std::int64_t number, Flags flags = 0) {
  return {.t_us = (number + 1) * kPeriodUs, .flags = flags};
}

double signal_of(std::int64_t number) {
  return static_cast<double>(1000 * (number + 1)) * 3.3 / 65535;
}

TEST_CASE("Estimates that come long after their samples stand beside them", "[report]") {
  const RigFile rig = parse_rig(std::string(kRigText), "rig.toml").value();
  ReportRows rows(rig.rig, kAcquisition, 0);
  for (int i = 0; i < 500; ++i) {
    rows.take(sample(i), 0);
  }
  for (int i = 0; i < 500; ++i) {
    rows.take(estimate(i));
  }
  const std::vector<LiveRow> kept = rows.finish();
  REQUIRE(kept.size() == 500);
  for (int i = 0; i < 500; ++i) {
    CHECK(kept[static_cast<std::size_t>(i)].t_s == Approx(0.05 * i).margin(1e-9));
    CHECK(kept[static_cast<std::size_t>(i)].signal_v[0] == Approx(signal_of(i)));
  }
}

TEST_CASE("After a restart the time goes on by the events' clock", "[report]") {
  const RigFile rig = parse_rig(std::string(kRigText), "rig.toml").value();
  ReportRows rows(rig.rig, kAcquisition, 0);
  RecordedTime time;
  const auto take = [&](const Sample& one) { rows.take(one, time.follow(one)); };
  time.follow(RecordingEvent{.kind = "pong", .utc_us = 1'000'000'000});
  for (int i = 0; i < 100; ++i) {
    take(sample(i));
  }
  // The last sample was 4.95 s after the event; the board is back 2 s later.
  time.follow(RecordingEvent{.kind = "boot", .utc_us = 1'006'950'000});
  take(sample(0, flag::kRestarted));
  take(sample(1));
  for (int i = 0; i < 100; ++i) {
    rows.take(estimate(i));
  }
  rows.take(estimate(0, flag::kRestarted));
  rows.take(estimate(1));
  const std::vector<LiveRow> kept = rows.finish();
  REQUIRE(kept.size() == 102);
  CHECK(kept[99].t_s == Approx(4.95));
  CHECK(kept[99].signal_v[0] == Approx(signal_of(99)));
  CHECK(kept[100].t_s == Approx(6.95));
  CHECK(kept[100].signal_v[0] == Approx(signal_of(0)));
  CHECK(kept[101].t_s == Approx(7.0));
}

TEST_CASE("An event without the board's time stands at the host's, never before it happened",
          "[report]") {
  RecordedTime time;
  time.follow(RecordingEvent{.kind = "connected", .utc_us = 1'000'000'000});
  time.follow(sample(0));
  time.follow(sample(1));  // 50 ms after the event
  CHECK(time.moment_s({.kind = "mark"}) == Approx(0.05));
  CHECK(time.moment_s({.kind = "mark", .utc_us = 1'000'300'000}) == Approx(0.3));
  CHECK(time.moment_s({.kind = "mark", .utc_us = 1'000'010'000}) == Approx(0.05));
  const RecordingEvent dated{
      .kind = "mark", .utc_us = 1'000'300'000, .fields = {{"t_us", std::int64_t{60'000}}}};
  CHECK(time.moment_s(dated) == Approx(0.01));
  time.follow(RecordingEvent{.kind = "boot"});
  CHECK_FALSE(time.moment_s(dated));
}

TEST_CASE("Where rows are thinned, one without answers stands in each dropout", "[report]") {
  const RigFile rig = parse_rig(std::string(kRigText), "rig.toml").value();
  constexpr double kBinS = 10;
  ReportRows rows(rig.rig, kAcquisition, kBinS);
  for (int i = 0; i < 100; ++i) {
    if ((i >= 40 && i < 44) || (i >= 60 && i < 62)) {
      continue;  // five periods from row to row, and three, which may be a pause
    }
    rows.take(sample(i), 0);
    Estimate<double> one = estimate(i);
    one.attitude.emplace();
    one.attitude->angles.theta1_rad = 0.001 * i;
    rows.take(one);
  }
  CHECK(rows.breaks() == 1);
  std::vector<double> times;
  std::vector<bool> answers;
  for (const LiveRow& row : rows.finish()) {
    times.push_back(row.t_s);
    answers.push_back(!std::isnan(row.theta1_rad));
  }
  // The curves rise: the ends, and what stands beside the dropout.
  REQUIRE(times.size() == 5);
  CHECK(times[1] == Approx(0.05 * 39));
  CHECK(times[2] == Approx(0.05 * 41.5));
  CHECK(times[3] == Approx(0.05 * 44));
  CHECK(answers == std::vector<bool>{true, true, false, true, true});
}

TEST_CASE("Only very long recordings are thinned", "[report]") {
  CHECK(report_bin_s(150'000, 7500, 2) == 0);
  CHECK(report_bin_s(3'600'000, 3600, 2) == Approx(0.288));  // 12 rows of 12,500 bins
}

TEST_CASE("Columns are base64 of little-endian numbers", "[report]") {
  const std::vector<LiveRow> rows = {{.t_s = 1, .theta1_rad = 0.5, .flags = 3}};
  const std::string text = report_points(rows, 1);
  // Of Python's struct and base64: pack('<d', 1), pack('<f', 0.5), pack('<f', nan), pack('<I', 3).
  CHECK(text.find(R"("t_s":"AAAAAAAA8D8=")") != std::string::npos);
  CHECK(text.find(R"("theta1_rad":"AAAAPw==")") != std::string::npos);
  CHECK(text.find(R"("theta2_rad":"AADAfw==")") != std::string::npos);
  CHECK(text.find(R"("gap_m":["AADAfw=="])") != std::string::npos);
  CHECK(text.find(R"("flags":"AwAAAA==")") != std::string::npos);
}

TEST_CASE("Nothing in a recording ends the script that it stands in", "[report]") {
  const std::string mischief = "</script><script>alert(1)</script>";
  const std::string html = report_page({.session = "{}",
                                        .state = "{}",
                                        .recorded = "{}",
                                        .notes = {},
                                        .analysis = {{"Q", mischief}},
                                        .rig_toml = mischief,
                                        .points = "{}"});
  CHECK(html.find("alert(1)") != std::string::npos);
  CHECK(html.find(mischief) == std::string::npos);
  CHECK(html.find("<script>alert") == std::string::npos);
}

}  // namespace
}  // namespace penduline::test
