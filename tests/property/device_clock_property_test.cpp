// SPDX-License-Identifier: Apache-2.0
// How well the board's clock is read over links with jitter, outliers and drift, beside what plain
// least squares and the exchange of the shortest round trip reach (`--success` prints the figures).
#include <rapidcheck/catch.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "host/session/device_clock.hpp"
#include "tests/property/generators.hpp"
#include "tests/property/simulated_link.hpp"

namespace penduline::test {
namespace {

constexpr int kSettledS = 30;

/// Errors of the host's times of samples, five between two exchanges.
struct Errors {
  double filter_us = 0;  ///< RMS, once settled, like the next two
  double least_squares_us = 0;
  double shortest_us = 0;
  double drift_ppm = 0;
  double worst_share = 0;        ///< largest error of all, in parts of its uncertainty
  double worst_drift_share = 0;  ///< the drift's likewise, once settled
};

/// Errors on links that differ in their seed only.
Errors errors_of(LinkSettings settings, int links = 10, int seconds = 400) {
  Errors errors;
  double moments = 0;
  double drifts = 0;
  for (int i = 0; i < links; ++i, ++settings.seed) {
    SimulatedLink link(settings);
    DeviceClock clock;
    LastMinute references;
    for (int s = 0; s < seconds; ++s) {
      const ClockExchange exchange = link.next();
      clock.take(exchange);
      references.take(exchange);
      for (int sample = 0; sample < 5; ++sample) {
        const double host_us = static_cast<double>(exchange.received_us) + link.uniform() * 1e6;
        const auto t_us = static_cast<std::int64_t>(link.board_us(host_us));
        const auto moment = clock.host_moment(t_us).value();
        const double error_us = static_cast<double>(moment.monotonic_us) - host_us;
        errors.worst_share =
            std::max(errors.worst_share, std::abs(error_us) / moment.uncertainty_us);
        if (s >= kSettledS) {
          ++moments;
          errors.filter_us += error_us * error_us;
          errors.least_squares_us += std::pow(references.least_squares_us(t_us) - host_us, 2);
          errors.shortest_us += std::pow(references.shortest_us(t_us) - host_us, 2);
        }
      }
      if (s >= kSettledS) {
        const auto drift = clock.drift().value();
        const double error_ppm =
            drift.ppm - link.drift_ppm(static_cast<double>(exchange.received_us));
        ++drifts;
        errors.drift_ppm += error_ppm * error_ppm;
        errors.worst_drift_share =
            std::max(errors.worst_drift_share, std::abs(error_ppm) / drift.uncertainty_ppm);
      }
    }
  }
  for (double* sum : {&errors.filter_us, &errors.least_squares_us, &errors.shortest_us}) {
    *sum = std::sqrt(*sum / moments);
  }
  errors.drift_ppm = std::sqrt(errors.drift_ppm / drifts);
  return errors;
}

/// What a link may cost, by its jitter.
struct Bar {
  double jitter_us;
  double filter_us;
  double drift_ppm;
};

TEST_CASE("Jitter and outliers of 100 ms are read to a small part of the jitter", "[clock]") {
  const Bar bar = GENERATE(Bar{100, 10, 0.4}, Bar{1000, 70, 2}, Bar{5000, 300, 9});
  const Errors errors = errors_of({.jitter_us = bar.jitter_us});
  CAPTURE(bar.jitter_us);
  CHECK(errors.filter_us < bar.filter_us);
  CHECK(errors.drift_ppm < bar.drift_ppm);
  CHECK(errors.worst_share < 1);
  CHECK(errors.filter_us < errors.shortest_us / 3);
  CHECK(errors.filter_us < errors.least_squares_us / 3);
}

TEST_CASE("Without outliers and drift it is better than least squares and as good as the shortest",
          "[clock]") {
  const double jitter_us = GENERATE(100.0, 1000.0, 5000.0);
  const Errors errors = errors_of({.drift_ppm = 0, .jitter_us = jitter_us, .outliers = 0});
  CAPTURE(jitter_us);
  // The shortest alone is at its best where it need not know the drift.
  CHECK(errors.filter_us < 1.25 * errors.shortest_us);
  CHECK(errors.drift_ppm < 9);
  CHECK(errors.filter_us < errors.least_squares_us / 2);
}

TEST_CASE("A drift that changes slowly, as with temperature, is followed", "[clock]") {
  // 5 ppm, at most 0.026 ppm/s: a board that warms up by 10 K in its first minutes.
  const Bar bar = GENERATE(Bar{100, 13, 0.8}, Bar{1000, 80, 2.2}, Bar{5000, 300, 6});
  const Errors errors = errors_of({.jitter_us = bar.jitter_us, .warming_ppm = 5}, 5, 1300);
  CAPTURE(bar.jitter_us);
  CHECK(errors.filter_us < bar.filter_us);
  CHECK(errors.drift_ppm < bar.drift_ppm);
  CHECK(errors.worst_share < 1);
}

TEST_CASE("Jitter on one way costs little more, and the uncertainty covers it", "[clock]") {
  const Bar bar = GENERATE(Bar{100, 25, 1}, Bar{1000, 120, 4}, Bar{5000, 500, 15});
  const Errors errors = errors_of({.jitter_us = bar.jitter_us, .jitter_one_way = true});
  CAPTURE(bar.jitter_us);
  CHECK(errors.filter_us < bar.filter_us);
  CHECK(errors.drift_ppm < bar.drift_ppm);
  CHECK(errors.worst_share < 1);
  CHECK(errors.filter_us < errors.shortest_us / 3);
  CHECK(errors.filter_us < errors.least_squares_us / 3);
}

TEST_CASE("On any such link the truth is within the uncertainty, from the first Pong on",
          "[clock]") {
  rc::prop("worst error and drift", [] {
    LinkSettings settings{.drift_ppm = *in_steps(-200, 200),
                          .jitter_us = std::exp(*in_steps(std::log(50), std::log(10'000))),
                          .jitter_one_way = *rc::gen::arbitrary<bool>(),
                          .least_us = *in_steps(10, 2000),
                          .outliers = *in_steps(0, 0.3),
                          .warming_ppm = *in_steps(-5, 5),
                          .seed = *rc::gen::arbitrary<std::uint64_t>()};
    const Errors errors = errors_of(settings, 1, 200);
    // Twice a standard deviation does not hold a hundred times out of a hundred.
    RC_ASSERT(errors.worst_share < 1.5);
    RC_ASSERT(errors.worst_drift_share < 4);
  });
}

TEST_CASE("Recorded exchanges give every answer again, to the last bit", "[clock]") {
  SimulatedLink link({.drift_ppm = -37});
  DeviceClock live;
  DeviceClock replayed;
  for (int s = 0; s < 500; ++s) {
    const ClockExchange exchange = link.next();
    const auto event = parse_event(event_line(event_of(exchange))).value();
    CHECK(live.take(exchange) == replayed.take(exchange_of(event).value()));
    const auto moment = live.host_moment(exchange.t_us + 500'000).value();
    const auto again = replayed.host_moment(exchange.t_us + 500'000).value();
    REQUIRE(again.monotonic_us == moment.monotonic_us);
    REQUIRE(again.utc_us == moment.utc_us);
    REQUIRE(again.uncertainty_us == moment.uncertainty_us);
  }
  CHECK(live.text() == replayed.text());
}

TEST_CASE("Only differences of times count", "[clock]") {
  rc::prop("shifted clocks give shifted answers", [] {
    const std::int64_t host_us = *rc::gen::inRange<std::int64_t>(0, 1'000'000'000'000);
    const std::int64_t board_us = *rc::gen::inRange<std::int64_t>(0, 1'000'000'000'000);
    SimulatedLink link({.seed = *rc::gen::arbitrary<std::uint64_t>()});
    DeviceClock clock;
    DeviceClock shifted;
    for (int s = 0; s < 50; ++s) {
      ClockExchange exchange = link.next();
      clock.take(exchange);
      const auto moment = clock.host_moment(exchange.t_us).value();
      exchange.sent_us += host_us;
      exchange.received_us += host_us;
      exchange.t_us += board_us;
      shifted.take(exchange);
      const auto shifted_moment = shifted.host_moment(exchange.t_us).value();
      // Offsets of a million seconds leave a thousandth of a microsecond to rounding.
      RC_ASSERT(std::abs(shifted_moment.monotonic_us - host_us - moment.monotonic_us) <= 1);
      RC_ASSERT(std::abs(shifted_moment.uncertainty_us - moment.uncertainty_us) < 0.01);
    }
  });
}

}  // namespace
}  // namespace penduline::test
