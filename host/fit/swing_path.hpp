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

/// The speed below which dry friction is rounded off, so that a path is smooth in what decides it.
inline constexpr double kDryRoundingRadPerS = 0.001;

/// The states at `times_s`, which rise from the moment of `start` on. Steps of a hundredth of the
/// small swing's period at the most (Runge-Kutta, fourth order), shorter where the mass turns round
/// under dry friction. A mass that comes to a standstill where gravity pulls less than dry friction
/// holds stays there. Not finite from where the numbers run away.
[[nodiscard]] std::vector<SwingState<double>> swing_path(const FreeSwing& swing,
                                                         const SwingState<double>& start,
                                                         std::span<const double> times_s);

}  // namespace penduline
