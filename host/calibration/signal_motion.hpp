// SPDX-License-Identifier: Apache-2.0
// Whether a signal moves as a pendulum makes it move, told apart from its noise.
#pragma once

#include <cstddef>
#include <vector>

#include "common/disc_plane.hpp"

namespace penduline {

/// What of a signal is no noise. Each is 0 where noise alone does as much in one of a thousand
/// minutes or more, or where there are too few samples to tell.
struct SignalMotion {
  double drift_v = 0;   ///< from the mean of the first third to that of the last
  double swing_v = 0;   ///< RMS of the strongest oscillation about a straight line
  double swing_hz = 0;  ///< its frequency; where it is about one over the recording's length or
                        ///< less, it may be any slow change
};

/// Fewest samples of which motion can be told.
inline constexpr std::size_t kFewestForMotion = 20;
/// What is longer is looked at in parts, of which the one that moves most counts.
inline constexpr double kLongestMotionSpanS = 60;

/// RMS of what is new in each sample (von Neumann); 0 where there are less than two.
[[nodiscard]] double noise_of(const std::vector<double>& volts);

/// Looks for oscillations up to `fastest_hz` in samples taken at `rate_hz`; that a few of them are
/// missing does not matter.
[[nodiscard]] SignalMotion motion_of(const std::vector<double>& volts, double rate_hz,
                                     double fastest_hz);

/// Nearer to the pendulum's axis than this a sensor does not see a tilt.
inline constexpr double kOnAxisM = 1e-3;

/// A sensor's distance from the axis, by which a small tilt changes its gap; of one on the axis,
/// the farthest sensor's.
[[nodiscard]] double tilt_arm_m(const SensorLayout<double>& layout, std::size_t sensor);

}  // namespace penduline
