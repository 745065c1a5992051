// SPDX-License-Identifier: Apache-2.0
// The gap that a sensor sees at given angles, with its derivative by them.
#pragma once

#include <cmath>
#include <cstddef>

#include "common/disc_plane.hpp"

namespace penduline {

/// The disc at known angles, and how its slopes change with them (method.md eq. 28).
template <class Scalar>
struct Tilt {
  DiscPlane<Scalar> plane{Slopes<Scalar>{}, 0};
  Scalar a_by_theta1 = 0;
  Scalar a_by_theta2 = 0;
  Scalar b_by_theta1 = 0;
};

/// By sines and cosines alone: a board has no time for roots and tangents.
template <class Scalar>
[[nodiscard]] Tilt<Scalar> tilt_at(const Angles<Scalar>& angles) {
  const Scalar secant1 = 1 / std::cos(angles.theta1_rad);
  const Scalar secant2 = 1 / std::cos(angles.theta2_rad);
  const Scalar secant = secant1 * secant2;  // of the rod against the vertical
  const Slopes<Scalar> slopes{.a = -std::sin(angles.theta2_rad) * secant,
                              .b = std::sin(angles.theta1_rad) * secant1};
  const Scalar excess = (slopes.a * slopes.a + slopes.b * slopes.b) / (1 + secant);
  return {.plane = DiscPlane<Scalar>(slopes, excess),
          .a_by_theta1 = slopes.a * slopes.b,
          .a_by_theta2 = -secant * secant2,
          .b_by_theta1 = secant1 * secant1};
}

template <class Scalar>
struct GapGradient {
  Scalar gap_m;
  Scalar by_theta1_m;
  Scalar by_theta2_m;
};

/// Gap and derivative (method.md eqs. 11 and 28).
template <class Scalar>
[[nodiscard]] GapGradient<Scalar> gap_gradient(const SensorLayout<Scalar>& layout,
                                               std::size_t sensor, const Tilt<Scalar>& tilt) {
  const Vector3<Scalar>& face = layout.position_m[sensor];
  const Vector2<Scalar> rise = tilt.plane.rise_gradient_m(face.x(), face.y(), layout.disc_offset_m);
  return {.gap_m = tilt.plane.gap_m(layout, sensor),
          .by_theta1_m = -(rise.x() * tilt.a_by_theta1 + rise.y() * tilt.b_by_theta1),
          .by_theta2_m = -rise.x() * tilt.a_by_theta2};
}

/// The same where only the angles are known.
template <class Scalar>
[[nodiscard]] GapGradient<Scalar> gap_gradient(const SensorLayout<Scalar>& layout,
                                               std::size_t sensor, const Angles<Scalar>& angles) {
  return gap_gradient(layout, sensor, tilt_at(angles));
}

}  // namespace penduline
