// SPDX-License-Identifier: Apache-2.0
// The periodogram of a signal, and what noise would make of it.
#include "host/calibration/signal_motion.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <numeric>

namespace penduline {
namespace {

/// Noise passes for motion once in so many recordings.
constexpr double kChance = 1e-3;
/// Standard deviations that a normal number exceeds with that chance.
constexpr double kCertainSigmas = 3.29;

double mean_of(const double* begin, const double* end) {
  return std::accumulate(begin, end, 0.0) / static_cast<double>(end - begin);
}

/// Means of so many samples each: all that slow motion needs.
std::vector<double> means_of(const std::vector<double>& volts, std::size_t width) {
  std::vector<double> means;
  for (std::size_t i = 0; i + width <= volts.size(); i += width) {
    means.push_back(mean_of(&volts[i], &volts[i] + width));
  }
  return means;
}

/// Takes mean and straight line out; returns the variance of the rest.
double straighten(std::vector<double>& values) {
  const auto count = static_cast<double>(values.size());
  const double middle = (count - 1) / 2;
  const double mean = mean_of(values.data(), values.data() + values.size());
  double slope = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    slope += (static_cast<double>(i) - middle) * values[i];
  }
  slope *= 12 / (count * (count * count - 1));
  double squares = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] -= mean + slope * (static_cast<double>(i) - middle);
    squares += values[i] * values[i];
  }
  return squares / count;
}

struct Peak {
  double power = 0;        ///< half the square of an amplitude
  double cycles = 0;       ///< in the whole
  double frequencies = 0;  ///< that were looked at
};

/// The strongest oscillation of one to `most_cycles` cycles.
Peak strongest(const std::vector<double>& values, double most_cycles) {
  const auto count = static_cast<double>(values.size());
  Peak peak;
  for (int halves = 2; halves <= 2 * most_cycles; ++halves) {
    const double cycles = halves / 2.0;
    const std::complex<double> turn = std::polar(1.0, 2 * std::numbers::pi * cycles / count);
    std::complex<double> phase = 1;
    std::complex<double> sum = 0;
    for (const double value : values) {
      sum += value * phase;
      phase *= turn;
    }
    const double power = 2 * std::norm(sum) / (count * count);
    ++peak.frequencies;
    if (power > peak.power) {
      peak.power = power;
      peak.cycles = cycles;
    }
  }
  return peak;
}

/// Puts the part's oscillation into `motion` where it is the strongest yet and more than noise: of
/// white noise's variance, the share at one frequency has a beta distribution, of 2 of the N - 2
/// degrees of freedom that a straight line leaves.
void find_swing(std::vector<double> values, double rate_hz, double fastest_hz,
                SignalMotion& motion) {
  const auto count = static_cast<double>(values.size());
  const double variance = straighten(values);
  if (values.size() < kFewestForMotion || !(variance > 0)) {
    return;
  }
  const Peak peak = strongest(values, std::min(fastest_hz / rate_hz, 0.5) * count);
  const double share = std::min(peak.power / variance, 1.0);
  const double chance = peak.frequencies * std::pow(1 - share, (count - 4) / 2);
  if (chance < kChance && std::sqrt(peak.power) > motion.swing_v) {
    motion.swing_v = std::sqrt(peak.power);
    motion.swing_hz = peak.cycles / count * rate_hz;
  }
}

}  // namespace

double noise_of(const std::vector<double>& volts) {
  double step_squares = 0;
  for (std::size_t i = 1; i < volts.size(); ++i) {
    step_squares += std::pow(volts[i] - volts[i - 1], 2);
  }
  // Half the mean squared step is the variance of what is new.
  return volts.size() > 1 ? std::sqrt(step_squares / (2 * static_cast<double>(volts.size() - 1)))
                          : 0;
}

SignalMotion motion_of(const std::vector<double>& volts, double rate_hz, double fastest_hz) {
  SignalMotion motion;
  if (volts.size() < kFewestForMotion) {
    return motion;
  }
  const auto third = static_cast<std::ptrdiff_t>(volts.size() / 3);
  const double* const end = volts.data() + volts.size();
  const double drift_v = mean_of(end - third, end) - mean_of(volts.data(), volts.data() + third);
  const double drift_sigma_v = noise_of(volts) * std::sqrt(2 / static_cast<double>(third));
  motion.drift_v = std::abs(drift_v) > kCertainSigmas * drift_sigma_v ? drift_v : 0;

  constexpr double kMeansACycle = 8;
  const auto width =
      static_cast<std::size_t>(std::max(1.0, std::floor(rate_hz / (kMeansACycle * fastest_hz))));
  const std::vector<double> means = means_of(volts, width);
  const double mean_rate_hz = rate_hz / static_cast<double>(width);
  const auto parts = static_cast<std::size_t>(
      std::ceil(static_cast<double>(means.size()) / (kLongestMotionSpanS * mean_rate_hz)));
  for (std::size_t i = 0; i < parts; ++i) {
    const auto at = [&](std::size_t part) {
      return means.begin() + static_cast<std::ptrdiff_t>(means.size() * part / parts);
    };
    find_swing({at(i), at(i + 1)}, mean_rate_hz, fastest_hz, motion);
  }
  return motion;
}

double tilt_arm_m(const SensorLayout<double>& layout, std::size_t sensor) {
  const double arm_m = layout.position_m[sensor].head<2>().norm();
  double farthest_m = arm_m;
  for (std::size_t i = 0; i < layout.count; ++i) {
    farthest_m = std::max(farthest_m, layout.position_m[i].head<2>().norm());
  }
  return arm_m < kOnAxisM ? farthest_m : arm_m;
}

}  // namespace penduline
