// SPDX-License-Identifier: Apache-2.0
// The gap that a sensor sees at given angles, with its derivative by them.
#pragma once

#include <cmath>
#include <cstddef>

#include "common/disc_plane.hpp"

namespace penduline {

template <class Scalar>
struct GapGradient {
  Scalar gap_m;
  Scalar by_theta1_m;
  Scalar by_theta2_m;
};

/// Gap and derivative (method.md eqs. 11 and 28).
template <class Scalar>
[[nodiscard]] GapGradient<Scalar> gap_gradient(const SensorLayout<Scalar>& layout,
                                               std::size_t sensor, const Angles<Scalar>& angles) {
  const Slopes<Scalar> slopes = slopes_of(angles);
  const DiscPlane<Scalar> plane(slopes);
  const Vector3<Scalar>& face = layout.position_m[sensor];
  const Vector2<Scalar> rise = plane.rise_gradient_m(face.x(), face.y(), layout.disc_offset_m);
  // b = tan(theta1), a = -tan(theta2) sqrt(1 + b^2)
  const Scalar square = 1 + slopes.b * slopes.b;
  const Scalar a_by_theta2 = -(square + slopes.a * slopes.a) / std::sqrt(square);
  return {.gap_m = plane.gap_m(layout, sensor),
          .by_theta1_m = -(rise.x() * slopes.a * slopes.b + rise.y() * square),
          .by_theta2_m = -rise.x() * a_by_theta2};
}

}  // namespace penduline
