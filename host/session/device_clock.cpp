// SPDX-License-Identifier: Apache-2.0
// A Kalman filter whose measurements are worth what their round trips allow.
#include "host/session/device_clock.hpp"

#include <fmt/format.h>

#include <cmath>

namespace penduline {
namespace {

/// What a clock may be off before anything is known: a crystal's 200 ppm.
constexpr double kFirstDrift = 200e-6;
/// Random walk of the drift in a second: a crystal that warms up.
constexpr double kDriftWalk = 0.1e-6;
/// What two clocks that count microseconds and a scheduler leave at best.
constexpr double kResolutionUs = 10;
constexpr double kSecondsPerUs = 1e-6;
/// Rejections in a row after which the old knowledge is what is wrong.
constexpr int kWrongInARow = 3;
/// Variance of what is equally likely anywhere in an interval of length 1.
constexpr double kUniformVariance = 1.0 / 12;

double squared(double value) {
  return value * value;
}

/// Host's time less board's, if both ways take as long.
double measured_offset_us(const ClockExchange& exchange) {
  return static_cast<double>(exchange.sent_us - exchange.t_us) +
         static_cast<double>(exchange.received_us - exchange.sent_us) / 2;
}

}  // namespace

void DeviceClock::reset() {
  used_ = 0;
}

void DeviceClock::begin(const ClockExchange& exchange) {
  const std::int64_t round_trip_us = exchange.received_us - exchange.sent_us;
  round_trips_ = RoundTrips();
  round_trips_.push(round_trip_us);
  shortest_us_ = round_trip_us;
  reference_us_ = exchange.t_us;
  state_ = {.offset_us = measured_offset_us(exchange),
            .offset_variance = squared(static_cast<double>(round_trip_us)) * kUniformVariance +
                               squared(kResolutionUs),
            .drift_variance = squared(kFirstDrift)};
  one_sided_us_ = 0;
  used_ = 1;
  rejected_in_a_row_ = 0;
}

DeviceClock::State DeviceClock::at(std::int64_t t_us) const {
  const auto us = static_cast<double>(t_us - reference_us_);
  const double seconds = std::abs(us) * kSecondsPerUs;
  // Of the drift's random walk, and of what it adds to the offset.
  const double walked = squared(kDriftWalk) * seconds;
  return {.offset_us = state_.offset_us + state_.drift * us,
          .drift = state_.drift,
          .offset_variance = state_.offset_variance + 2 * us * state_.covariance +
                             us * us * state_.drift_variance + walked * us * us / 3,
          .covariance = state_.covariance + us * state_.drift_variance + walked * us / 2,
          .drift_variance = state_.drift_variance + walked};
}

double DeviceClock::uncertainty_us(const State& state) const {
  return static_cast<double>(shortest_us_) / 2 + one_sided_us_ +
         2 * std::sqrt(state.offset_variance);
}

double DeviceClock::doubt_us(std::int64_t round_trip_us) const {
  const auto count = static_cast<double>(round_trips_.count());
  const auto shortest = static_cast<double>(shortest_us_);
  const double usual_excess = static_cast<double>(round_trips_.median_us()) - shortest;
  return static_cast<double>(round_trip_us) - shortest +
         (usual_excess + shortest / count) / std::sqrt(count);
}

void DeviceClock::note_shortest(std::int64_t shortest_us) {
  if (shortest_us < shortest_us_) {
    // All that came before hid at least so much.
    state_.offset_variance +=
        squared(static_cast<double>(shortest_us_ - shortest_us)) * kUniformVariance;
  }
  shortest_us_ = shortest_us;
}

DeviceClock::Verdict DeviceClock::take(const ClockExchange& exchange) {
  const std::int64_t round_trip_us = exchange.received_us - exchange.sent_us;
  ++taken_;
  if (round_trip_us < 0) {
    ++rejected_;
    return Verdict::kRejected;
  }
  utc_less_monotonic_us_ = exchange.utc_us - exchange.received_us;
  if (used_ == 0 || exchange.t_us < reference_us_) {
    begin(exchange);
    return Verdict::kBegun;
  }
  round_trips_.push(round_trip_us);
  note_shortest(round_trips_.shortest_us());
  const State predicted = at(exchange.t_us);
  const double measured_us = measured_offset_us(exchange);
  const double most_us =
      static_cast<double>(round_trip_us) / 2 + uncertainty_us(predicted) + kResolutionUs;
  if (std::abs(measured_us - predicted.offset_us) > most_us) {
    ++rejected_;
    if (++rejected_in_a_row_ < kWrongInARow) {
      return Verdict::kRejected;
    }
    begin(exchange);
    return Verdict::kBegun;
  }
  rejected_in_a_row_ = 0;
  correct(predicted, measured_us, doubt_us(round_trip_us));
  reference_us_ = exchange.t_us;
  ++used_;
  return Verdict::kUsed;
}

void DeviceClock::correct(const State& predicted, double measured_us, double doubt_us) {
  const double variance = squared(doubt_us) * kUniformVariance + squared(kResolutionUs);
  const double total = predicted.offset_variance + variance;
  const double offset_gain = predicted.offset_variance / total;
  const double drift_gain = predicted.covariance / total;
  const double innovation = measured_us - predicted.offset_us;
  state_ = {.offset_us = predicted.offset_us + offset_gain * innovation,
            .drift = predicted.drift + drift_gain * innovation,
            .offset_variance = (1 - offset_gain) * predicted.offset_variance,
            .covariance = (1 - offset_gain) * predicted.covariance,
            .drift_variance = predicted.drift_variance - drift_gain * predicted.covariance};
  one_sided_us_ += offset_gain * (doubt_us / 2 - one_sided_us_);
}

std::optional<DeviceClock::HostMoment> DeviceClock::host_moment(std::int64_t t_us) const {
  if (used_ == 0) {
    return std::nullopt;
  }
  const State state = at(t_us);
  const std::int64_t monotonic_us = t_us + std::llround(state.offset_us);
  return HostMoment{.monotonic_us = monotonic_us,
                    .utc_us = monotonic_us + utc_less_monotonic_us_,
                    .uncertainty_us = uncertainty_us(state)};
}

std::optional<DeviceClock::BoardMoment> DeviceClock::board_moment(std::int64_t monotonic_us) const {
  if (used_ == 0) {
    return std::nullopt;
  }
  // host = reference + us + offset + drift * us, solved for us.
  const double us =
      (static_cast<double>(monotonic_us - reference_us_) - state_.offset_us) / (1 + state_.drift);
  const std::int64_t t_us = reference_us_ + std::llround(us);
  if (t_us < 0) {
    return std::nullopt;
  }
  return BoardMoment{.t_us = t_us, .uncertainty_us = uncertainty_us(at(t_us))};
}

std::optional<DeviceClock::Drift> DeviceClock::drift() const {
  constexpr double kPpm = 1e6;
  if (used_ < 2) {
    return std::nullopt;
  }
  // The board counts 1 while the host counts 1 + drift.
  return Drift{.ppm = -state_.drift / (1 + state_.drift) * kPpm,
               .uncertainty_ppm = 2 * std::sqrt(state_.drift_variance) * kPpm};
}

std::string DeviceClock::text() const {
  constexpr double kUsPerMs = 1e3;
  const auto known = drift();
  if (!known) {
    return fmt::format("the board's clock is not known ({} Pongs, {} rejected)", taken_, rejected_);
  }
  return fmt::format(
      "the board's clock is {:.1f} +- {:.1f} ppm {} and known within {:.2f} ms ({} Pongs, {} "
      "rejected)",
      std::abs(known->ppm), known->uncertainty_ppm, known->ppm < 0 ? "slow" : "fast",
      uncertainty_us(state_) / kUsPerMs, taken_, rejected_);
}

}  // namespace penduline
