// SPDX-License-Identifier: Apache-2.0
// The paper's forward kinematics: Denavit-Hartenberg transforms and the chains of its two sensors.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <numbers>

#include "common/disc_plane.hpp"

namespace penduline {

template <class Scalar>
using Transform = Eigen::Matrix<Scalar, 4, 4>;

/// One row of a Denavit-Hartenberg table.
template <class Scalar>
struct DhRow {
  Scalar theta_rad = 0;
  Scalar d_m = 0;
  Scalar a_m = 0;
  Scalar alpha_rad = 0;
};

/// The transform of one row (paper Eq. 21, method.md eq. 1).
template <class Scalar>
[[nodiscard]] Transform<Scalar> dh_transform(const DhRow<Scalar>& row) {
  const Scalar sin_theta = std::sin(row.theta_rad);
  const Scalar cos_theta = std::cos(row.theta_rad);
  const Scalar sin_alpha = std::sin(row.alpha_rad);
  const Scalar cos_alpha = std::cos(row.alpha_rad);
  Transform<Scalar> transform;
  transform << cos_theta, -sin_theta * cos_alpha, sin_theta * sin_alpha, row.a_m * cos_theta,  //
      sin_theta, cos_theta * cos_alpha, -cos_theta * sin_alpha, row.a_m * sin_theta,           //
      0, sin_alpha, cos_alpha, row.d_m,                                                        //
      0, 0, 0, 1;
  return transform;
}

/// The rotations that Tables 1 and 2 share, then the two rows that lead to a reflection point. The
/// first row turns by theta1 - pi/2, not the printed pi/2 + theta1, which would put the disc above
/// the pivot; the third rows' turns are those that give Eqs. 22 and 23 (docs/paper.md, "Turns").
template <class Scalar>
[[nodiscard]] Transform<Scalar> disc_chain(const Angles<Scalar>& angles,
                                           const DhRow<Scalar>& to_disc,
                                           const DhRow<Scalar>& to_spot) {
  constexpr Scalar kQuarterTurn = std::numbers::pi_v<Scalar> / 2;
  return dh_transform<Scalar>({.alpha_rad = angles.theta1_rad - kQuarterTurn}) *
         dh_transform<Scalar>({.theta_rad = angles.theta2_rad + kQuarterTurn}) *
         dh_transform(to_disc) * dh_transform(to_spot);
}

/// Pivot frame to the reflection point of sensor Sx, reached by l1 across and l2 along the disc
/// (Table 1); the position column is Eq. 22.
template <class Scalar>
[[nodiscard]] Transform<Scalar> sensor_x_chain(const Angles<Scalar>& angles, Scalar disc_offset_m,
                                               Scalar l1_m, Scalar l2_m) {
  constexpr Scalar kPi = std::numbers::pi_v<Scalar>;
  return disc_chain<Scalar>(angles, {.a_m = disc_offset_m, .alpha_rad = kPi},
                            {.theta_rad = kPi / 2, .d_m = l1_m, .a_m = l2_m});
}

/// Pivot frame to the reflection point of sensor Sy, reached by l3 across and l4 along the disc
/// (Table 2); the position column is Eq. 23.
template <class Scalar>
[[nodiscard]] Transform<Scalar> sensor_y_chain(const Angles<Scalar>& angles, Scalar disc_offset_m,
                                               Scalar l3_m, Scalar l4_m) {
  constexpr Scalar kPi = std::numbers::pi_v<Scalar>;
  return disc_chain<Scalar>(angles, {.a_m = disc_offset_m},
                            {.theta_rad = -kPi / 2, .d_m = l3_m, .a_m = l4_m});
}

}  // namespace penduline
