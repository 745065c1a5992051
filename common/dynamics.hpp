// SPDX-License-Identifier: Apache-2.0
// The pendulum's equations of motion in the sensor's own angles, which have no singularity at rest.
#pragma once

#include <cmath>
#include <numbers>

#include "common/disc_plane.hpp"

namespace penduline {

template <class Scalar>
struct Pendulum {
  Scalar length_m = Scalar(0.3);
  Scalar mass_kg = Scalar(0.1);
  Scalar gravity_m_s2 = Scalar(9.8);
  Scalar damping_per_s = 0;
};

/// The pendulum's state; as a derivative, its change per second.
template <class Scalar>
struct SwingState {
  Scalar theta1_rad = 0;
  Scalar theta2_rad = 0;
  Scalar omega1_rad_s = 0;
  Scalar omega2_rad_s = 0;
};

/// Change of the state per second, damping linear in the rates (method.md eq. 4). Singular at
/// theta2 = +-pi/2, where the rod lies along X.
template <class Scalar>
[[nodiscard]] SwingState<Scalar> swing_derivative(const SwingState<Scalar>& state,
                                                  const Pendulum<Scalar>& pendulum) {
  const Scalar stiffness = pendulum.gravity_m_s2 / pendulum.length_m;
  const Scalar sin1 = std::sin(state.theta1_rad);
  const Scalar cos1 = std::cos(state.theta1_rad);
  const Scalar sin2 = std::sin(state.theta2_rad);
  const Scalar cos2 = std::cos(state.theta2_rad);
  return {.theta1_rad = state.omega1_rad_s,
          .theta2_rad = state.omega2_rad_s,
          .omega1_rad_s = 2 * sin2 / cos2 * state.omega1_rad_s * state.omega2_rad_s -
                          stiffness * sin1 / cos2 - pendulum.damping_per_s * state.omega1_rad_s,
          .omega2_rad_s = -sin2 * cos2 * state.omega1_rad_s * state.omega1_rad_s -
                          stiffness * cos1 * sin2 - pendulum.damping_per_s * state.omega2_rad_s};
}

/// Kinetic and potential energy in joules, 0 at rest (method.md eq. 5).
template <class Scalar>
[[nodiscard]] Scalar energy_j(const SwingState<Scalar>& state, const Pendulum<Scalar>& pendulum) {
  const Scalar cos2 = std::cos(state.theta2_rad);
  const Scalar speed1 = pendulum.length_m * cos2 * state.omega1_rad_s;
  const Scalar speed2 = pendulum.length_m * state.omega2_rad_s;
  // 1 - cos(theta1) cos(theta2), by half angles so that small tilts keep their digits.
  const Scalar half1 = std::sin(state.theta1_rad / 2);
  const Scalar half2 = std::sin(state.theta2_rad / 2);
  const Scalar height =
      2 * pendulum.length_m * (half1 * half1 + std::cos(state.theta1_rad) * half2 * half2);
  return pendulum.mass_kg *
         ((speed1 * speed1 + speed2 * speed2) / 2 + pendulum.gravity_m_s2 * height);
}

/// Frequency of small swings, sqrt(g / l) / (2 pi), in Hz.
template <class Scalar>
[[nodiscard]] Scalar small_swing_hz(const Pendulum<Scalar>& pendulum) {
  return std::sqrt(pendulum.gravity_m_s2 / pendulum.length_m) / (2 * std::numbers::pi_v<Scalar>);
}

}  // namespace penduline
