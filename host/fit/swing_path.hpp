// SPDX-License-Identifier: Apache-2.0
// How a real pendulum swings: the equations of motion with friction of three kinds, for fits.
#pragma once

#include <span>
#include <vector>

#include "common/dynamics.hpp"

namespace penduline {

/// Deceleration against the motion at the speed v, the rate of the rod's direction in rad/s:
/// linear v + quadratic v^2 + dry (method.md eq. 4 with `linear` alone).
struct Friction {
  double linear_per_s = 0;
  double quadratic_per_rad = 0;
  double dry_rad_s2 = 0;
};

/// What decides a free swing's path besides its start.
struct FreeSwing {
  double stiffness_1_s2 = 0;  ///< gravity over effective length
  Friction friction;
};

/// The states at `times_s`, which rise from the moment of `start` on. Steps of a hundredth of the
/// small swing's period at the most (Runge-Kutta, fourth order), so the path is smooth in all that
/// decides it; dry friction is rounded off below `kDryRounding_rad_s`.
inline constexpr double kDryRounding_rad_s = 0.01;
[[nodiscard]] std::vector<SwingState<double>> swing_path(const FreeSwing& swing,
                                                         const SwingState<double>& start,
                                                         std::span<const double> times_s);

}  // namespace penduline
