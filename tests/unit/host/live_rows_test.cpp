// SPDX-License-Identifier: Apache-2.0
// Tests of the rows that the page draws: one time that goes on, readings beside their angles.
#include "host/web/live_rows.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "tests/unit/host/rig_text.hpp"

namespace {

using namespace penduline;
using namespace penduline::test;

const RigFile kRig = parse_rig(std::string(kRigText), "rig.toml").value();

/// A sample at `t_us` whose first sensor reads `volts`, and an estimate of `estimate_us`.
LiveSample live(std::int64_t t_us, double volts, std::int64_t estimate_us, std::int64_t host_us = 0,
                Flags flags = 0) {
  LiveSample sample{.sample = {.t_us = t_us, .flags = flags},
                    .estimate = {.t_us = estimate_us, .flags = flags},
                    .host_us = host_us};
  sample.sample.readings[0].on = static_cast<std::int32_t>(std::lround(volts / 3.3 * 65535));
  return sample;
}

LiveRows rows_at_20_hz() {
  return {kRig.rig, Acquisition<double>{}};
}

TEST_CASE("The session's time begins at its first sample", "[web]") {
  LiveRows rows = rows_at_20_hz();
  CHECK(rows.next(live(7'000'000, 1, 7'000'000))->t_s == 0);
  CHECK(rows.next(live(7'050'000, 1, 7'050'000))->t_s == Approx(0.05));
}

TEST_CASE("After a restart of the board the time goes on by the host's clock", "[web]") {
  LiveRows rows = rows_at_20_hz();
  static_cast<void>(rows.next(live(7'000'000, 1, 7'000'000, 100'000'000)));
  static_cast<void>(rows.next(live(8'000'000, 1, 8'000'000, 101'000'000)));
  const auto row = rows.next(live(50'000, 1, 50'000, 104'500'000, flag::kRestarted));
  REQUIRE(row);
  CHECK(row->t_s == Approx(4.5));
  CHECK(rows.next(live(100'000, 1, 100'000, 104'550'000))->t_s == Approx(4.55));
  CHECK(rows.time().at_host_s(105'000'000) == Approx(5.0));
}

TEST_CASE("A row that would go back in time is left out", "[web]") {
  LiveRows rows = rows_at_20_hz();
  static_cast<void>(rows.next(live(1'000'000, 1, 1'000'000)));
  CHECK_FALSE(rows.next(live(900'000, 1, 900'000)));
  CHECK_FALSE(rows.next(live(1'000'000, 1, 1'000'000)));
  CHECK(rows.next(live(1'100'000, 1, 1'100'000)));
}

TEST_CASE("Readings stand beside the angles of their own moment, not of the newest sample",
          "[web]") {
  LiveRows rows = rows_at_20_hz();
  std::optional<LiveRow> row;
  for (int i = 0; i < 10; ++i) {
    row = rows.next(live(50'000 * i, 0.1 * i, 50'000 * i - 150'000));
  }
  REQUIRE(row);
  CHECK(row->t_s == Approx(0.3));
  CHECK(row->signal_v[0] == Approx(0.6).margin(1e-4));
  CHECK(row->gap_m[0] == Approx(0.031 - 0.006 * 0.6).margin(1e-6));
}

TEST_CASE("A sensor without a reading has neither signal nor gap", "[web]") {
  LiveRows rows = rows_at_20_hz();
  LiveSample sample = live(0, 1, 0);
  sample.sample.missing = 1;
  const auto row = rows.next(sample);
  REQUIRE(row);
  CHECK(std::isnan(row->signal_v[0]));
  CHECK(std::isnan(row->gap_m[0]));
  CHECK(row->signal_v[1] == 0);
  CHECK(std::isnan(row->theta1_rad));
}

}  // namespace
