// SPDX-License-Identifier: Apache-2.0
// Tests of the board's clock: what one, two and many exchanges say, restarts, steps, and replays.
// How well it does on links with jitter is in tests/property/device_clock_property_test.cpp.
#include "host/session/device_clock.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <string>

#include "host/output/fixed_decimals.hpp"

namespace {

using namespace penduline;

using Verdict = DeviceClock::Verdict;

constexpr std::int64_t kSecond = 1'000'000;
/// 2026-11-21T07:00:03Z less the host's time in these tests.
constexpr std::int64_t kUtcLessMonotonicUs = 1'795'244'403'000'000;

/// An exchange at the host's time `sent_us` with a board that is `offset_us` behind the host.
ClockExchange exchange(std::int64_t sent_us, std::int64_t offset_us = 5 * kSecond,
                       std::int64_t there_us = 100, std::int64_t back_us = 100) {
  const std::int64_t received_us = sent_us + there_us + back_us;
  return {.sent_us = sent_us,
          .t_us = sent_us + there_us - offset_us,
          .received_us = received_us,
          .utc_us = received_us + kUtcLessMonotonicUs};
}

/// A clock after exchanges in these seconds with a board that is `ppm` fast.
DeviceClock followed(int begin_s, int end_s, double ppm = 0) {
  DeviceClock clock;
  for (int s = begin_s; s < end_s; ++s) {
    clock.take(exchange(s * kSecond, 5 * kSecond - std::llround(ppm * s)));
  }
  return clock;
}

TEST_CASE("Before the first Pong nothing is known", "[clock]") {
  const DeviceClock clock;
  CHECK_FALSE(clock.host_moment(0));
  CHECK_FALSE(clock.drift());
  CHECK(clock.text() == "the board's clock is not known (0 Pongs, 0 rejected)");
}

TEST_CASE("The first Pong says the time, within its round trip and the worst drift", "[clock]") {
  DeviceClock clock;
  CHECK(clock.take(exchange(10 * kSecond)) == Verdict::kBegun);
  const auto moment = clock.host_moment(5 * kSecond + 100).value();
  CHECK(moment.monotonic_us == 10 * kSecond + 100);
  CHECK(moment.utc_us == 10 * kSecond + 100 + kUtcLessMonotonicUs);
  CHECK(moment.uncertainty_us >= 100);
  CHECK(moment.uncertainty_us < 250);
  // 10 s later two standard deviations of 200 ppm are 4 ms.
  CHECK(clock.host_moment(15 * kSecond)->uncertainty_us == Approx(4100).margin(100));
  CHECK_FALSE(clock.drift());
}

TEST_CASE("Exchanges without jitter give the time to the microsecond, before and after them",
          "[clock]") {
  const DeviceClock clock = followed(10, 40);
  for (const std::int64_t t_us : {0 * kSecond, 20 * kSecond, 60 * kSecond}) {
    CHECK(clock.host_moment(t_us)->monotonic_us == t_us + 5 * kSecond);
  }
}

TEST_CASE("The board's time at a moment of the host's is the way back", "[clock]") {
  CHECK_FALSE(DeviceClock().board_moment(10 * kSecond));
  const DeviceClock even = followed(10, 40);
  CHECK(even.board_moment(25 * kSecond)->t_us == 20 * kSecond);
  CHECK(even.board_moment(25 * kSecond)->uncertainty_us ==
        even.host_moment(20 * kSecond)->uncertainty_us);
  CHECK_FALSE(even.board_moment(5 * kSecond - 1));  // the board had not started
  const DeviceClock fast = followed(10, 40, 50);
  for (const std::int64_t t_us : {20 * kSecond, 34 * kSecond, 100 * kSecond}) {
    const std::int64_t host_us = fast.host_moment(t_us)->monotonic_us;
    CHECK(std::abs(fast.board_moment(host_us)->t_us - t_us) <= 1);
  }
}

TEST_CASE("The uncertainty is least at the exchanges and grows away from them", "[clock]") {
  const DeviceClock clock = followed(10, 40);
  const auto uncertainty_us = [&](int t_s) {
    return clock.host_moment(t_s * kSecond)->uncertainty_us;
  };
  CHECK(uncertainty_us(34) < uncertainty_us(60));
  CHECK(uncertainty_us(60) < uncertainty_us(600));
  CHECK(uncertainty_us(34) < uncertainty_us(5));
  // Nobody knows how 200 us of delay divide between the two ways.
  CHECK(uncertainty_us(34) > 100);
}

TEST_CASE("A fast board has a drift above 0, a slow one below", "[clock]") {
  const double ppm = GENERATE(-200.0, -12.0, 0.0, 150.0);
  const DeviceClock clock = followed(0, 300, ppm);
  const auto drift = clock.drift().value();
  CHECK(drift.ppm == Approx(ppm).margin(0.1));
  CHECK(drift.uncertainty_ppm < 2);
}

TEST_CASE("The summary says the drift and how well the time is known", "[clock]") {
  DeviceClock clock = followed(0, 300, 150);
  CHECK(clock.text().starts_with("the board's clock is 150.0 +- "));
  CHECK(clock.text().find(" ppm fast and known within 0.1") != std::string::npos);
  CHECK(clock.text().ends_with(" ms (300 Pongs, 0 rejected)"));
  CHECK(followed(0, 300, -150).text().find(" ppm slow and") != std::string::npos);
}

TEST_CASE("A long round trip moves nothing", "[clock]") {
  DeviceClock clock = followed(0, 60);
  CHECK(clock.take(exchange(60 * kSecond, 5 * kSecond, 100'000, 100)) == Verdict::kUsed);
  CHECK(clock.take(exchange(61 * kSecond, 5 * kSecond, 100, 100'000)) == Verdict::kUsed);
  CHECK(std::abs(clock.host_moment(57 * kSecond)->monotonic_us - 62 * kSecond) <= 1);
}

TEST_CASE("An exchange that contradicts all others is rejected and counted", "[clock]") {
  DeviceClock clock = followed(0, 60);
  CHECK(clock.take(exchange(60 * kSecond, 6 * kSecond)) == Verdict::kRejected);
  CHECK(clock.host_moment(57 * kSecond)->monotonic_us == 62 * kSecond);
  CHECK(clock.take(exchange(61 * kSecond)) == Verdict::kUsed);
  CHECK(clock.text().ends_with("(62 Pongs, 1 rejected)"));
}

TEST_CASE("A Pong before its Ping is rejected", "[clock]") {
  DeviceClock clock;
  CHECK(clock.take(exchange(10 * kSecond, 5 * kSecond, 100, -200)) == Verdict::kRejected);
  CHECK_FALSE(clock.host_moment(0));
}

TEST_CASE("After a host that slept the clock begins anew with the third Pong", "[clock]") {
  // CLOCK_MONOTONIC stood still for an hour while the board went on.
  DeviceClock clock = followed(0, 60);
  const std::int64_t offset_us = 5 * kSecond - 3600 * kSecond;
  CHECK(clock.take(exchange(60 * kSecond, offset_us)) == Verdict::kRejected);
  CHECK(clock.take(exchange(61 * kSecond, offset_us)) == Verdict::kRejected);
  CHECK(clock.take(exchange(62 * kSecond, offset_us)) == Verdict::kBegun);
  CHECK(clock.host_moment(3657 * kSecond)->monotonic_us == 62 * kSecond);
}

TEST_CASE("A board's time that goes back is a restart", "[clock]") {
  DeviceClock clock = followed(0, 60);
  CHECK(clock.take(exchange(61 * kSecond, 60 * kSecond)) == Verdict::kBegun);
  CHECK(clock.host_moment(2 * kSecond)->monotonic_us == 62 * kSecond);
}

TEST_CASE("A board that is known to have started anew is forgotten", "[clock]") {
  DeviceClock clock = followed(0, 60);
  clock.reset();
  CHECK_FALSE(clock.host_moment(0));
  CHECK_FALSE(clock.drift());
  CHECK(clock.take(exchange(100 * kSecond, 7 * kSecond)) == Verdict::kBegun);
  CHECK(clock.host_moment(93 * kSecond)->monotonic_us == 100 * kSecond);
  CHECK(clock.text() == "the board's clock is not known (61 Pongs, 0 rejected)");
}

TEST_CASE("A host's UTC that is set is followed at once, and nothing else moves", "[clock]") {
  DeviceClock clock = followed(0, 60);
  const auto before = clock.host_moment(60 * kSecond).value();
  ClockExchange after_step = exchange(60 * kSecond);
  after_step.utc_us += 3600 * kSecond;
  CHECK(clock.take(after_step) == Verdict::kUsed);
  const auto after = clock.host_moment(60 * kSecond).value();
  CHECK(after.monotonic_us == before.monotonic_us);
  CHECK(after.utc_us == before.utc_us + 3600 * kSecond);
}

TEST_CASE("A longer way, as by another cable, is believed when the short one has aged", "[clock]") {
  DeviceClock clock = followed(0, 60);
  // 2 ms there and 200 us back: half of the difference cannot be seen, and is said.
  for (int s = 60; s < 600; ++s) {
    CHECK(clock.take(exchange(s * kSecond, 5 * kSecond, 2000, 200)) == Verdict::kUsed);
  }
  const auto moment = clock.host_moment(600 * kSecond).value();
  CHECK(moment.monotonic_us - 605 * kSecond == Approx(-900).margin(20));
  CHECK(moment.uncertainty_us > 1000);
  CHECK(moment.uncertainty_us < 1500);
}

TEST_CASE("The length of a wait between two Pongs does not matter", "[clock]") {
  DeviceClock clock = followed(0, 60, 20);
  CHECK(clock.take(exchange(7200 * kSecond, 5 * kSecond - 20 * 7200)) == Verdict::kUsed);
  CHECK(clock.drift()->ppm == Approx(20).margin(0.1));
}

TEST_CASE("Exchanges come back from a recording as they went in", "[clock]") {
  const ClockExchange sent = exchange(10 * kSecond + 1);
  const std::string line = event_line(event_of(sent));
  CHECK(
      line ==
      "# event = { kind = \"pong\", utc = 2026-11-21T07:00:13.000201Z, sent_us = 10000001, t_us = "
      "5000101, received_us = 10000201 }\n");
  CHECK(exchange_of(parse_event(line).value()) == sent);
}

TEST_CASE("An event that is no whole Pong is no exchange", "[clock]") {
  RecordingEvent event = event_of(exchange(10 * kSecond));
  SECTION("another kind") {
    event.kind = "ping";
  }
  SECTION("no UTC") {
    event.utc_us.reset();
  }
  SECTION("a time is missing") {
    event.fields.pop_back();
  }
  SECTION("a time is below 0") {
    event.fields[0].value = std::int64_t{-1};
  }
  SECTION("a time is too large") {
    event.fields[1].value = std::int64_t{1} << 53U;
  }
  SECTION("a time is no whole number") {
    event.fields[2].value = 1.5;
  }
  CHECK_FALSE(exchange_of(event));
}

TEST_CASE("Unix seconds with six decimals have the whole microsecond", "[clock]") {
  // What a column of `fixed_decimals` gives for utc_us / 1e6, until the year 2100.
  for (const std::int64_t utc_us : {kUtcLessMonotonicUs + 1, std::int64_t{4'102'444'799'999'999}}) {
    std::string text;
    append_fixed(text, static_cast<double>(utc_us) / 1e6, 6);
    CHECK(text == fmt::format("{}.{:06}", utc_us / kSecond, utc_us % kSecond));
  }
}

}  // namespace
