// SPDX-License-Identifier: Apache-2.0
// The tilted disc as a plane z = a x + b y + c: gaps under sensors, angles, position of the mass.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstddef>

#include "common/sample.hpp"

namespace penduline {

template <class Scalar>
using Vector2 = Eigen::Matrix<Scalar, 2, 1>;
template <class Scalar>
using Vector3 = Eigen::Matrix<Scalar, 3, 1>;

/// The two rotations: theta1 about the fixed X axis, then theta2 about the turned Y axis. Each in
/// (-pi/2, pi/2) while the mass hangs below the pivot.
template <class Scalar>
struct Angles {
  Scalar theta1_rad = 0;
  Scalar theta2_rad = 0;
};

/// The disc's slopes along X and Y, the unknowns of the inverse (method.md eq. 7).
template <class Scalar>
struct Slopes {
  Scalar a = 0;
  Scalar b = 0;
};

/// Slopes of the disc at given angles (method.md eq. 7).
template <class Scalar>
[[nodiscard]] Slopes<Scalar> slopes_of(const Angles<Scalar>& angles) {
  return {.a = -std::tan(angles.theta2_rad) / std::cos(angles.theta1_rad),
          .b = std::tan(angles.theta1_rad)};
}

/// Angles of the rod at given slopes (method.md eq. 8).
template <class Scalar>
[[nodiscard]] Angles<Scalar> angles_of(const Slopes<Scalar>& slopes) {
  return {.theta1_rad = std::atan(slopes.b),
          .theta2_rad = std::atan(-slopes.a / std::sqrt(1 + slopes.b * slopes.b))};
}

/// As many zero vectors as a rig may have sensors: Eigen's own `{}` leaves its numbers unset.
template <class Vector>
[[nodiscard]] std::array<Vector, kMaxSensors> zero_vectors() {
  std::array<Vector, kMaxSensors> vectors;
  vectors.fill(Vector::Zero());
  return vectors;
}

/// Where the sensors stand and how far the disc is from the pivot.
template <class Scalar>
struct SensorLayout {
  /// Of each sensor's face; it looks down.
  std::array<Vector3<Scalar>, kMaxSensors> position_m = zero_vectors<Vector3<Scalar>>();
  std::size_t count = 0;
  Scalar disc_offset_m = 0;  ///< pivot to disc along the rod (the paper's lp)
};

/// The disc at one tilt.
template <class Scalar>
class DiscPlane {
 public:
  explicit DiscPlane(const Slopes<Scalar>& slopes) : slopes_(slopes) {
    const Scalar squares = slopes.a * slopes.a + slopes.b * slopes.b;
    const Scalar secant = std::sqrt(1 + squares);
    excess_ = squares / (1 + secant);
    cosine_ = 1 / secant;
  }

  /// The same where the excess 1/cos(tilt) - 1 that belongs to the slopes is known already.
  DiscPlane(const Slopes<Scalar>& slopes, Scalar excess)
      : slopes_(slopes), excess_(excess), cosine_(1 / (1 + excess)) {}

  /// How far the disc under (x, y) stands above the rest plane z = -offset (method.md eq. 9).
  /// Written so that near rest no digits are lost.
  [[nodiscard]] Scalar rise_m(Scalar x_m, Scalar y_m, Scalar offset_m) const {
    return x_m * slopes_.a + y_m * slopes_.b - offset_m * excess_;
  }

  /// Derivative of `rise_m` by the slopes (method.md eq. 10).
  [[nodiscard]] Vector2<Scalar> rise_gradient_m(Scalar x_m, Scalar y_m, Scalar offset_m) const {
    return {x_m - offset_m * slopes_.a * cosine_, y_m - offset_m * slopes_.b * cosine_};
  }

  /// The gap that a sensor of the layout sees (method.md eq. 11).
  [[nodiscard]] Scalar gap_m(const SensorLayout<Scalar>& layout, std::size_t sensor) const {
    const Vector3<Scalar>& face = layout.position_m[sensor];
    return face.z() + layout.disc_offset_m - rise_m(face.x(), face.y(), layout.disc_offset_m);
  }

  /// Unit vector along the rod from the pivot to the mass (method.md eq. 6).
  [[nodiscard]] Vector3<Scalar> rod() const {
    return {slopes_.a * cosine_, slopes_.b * cosine_, -cosine_};
  }

  /// cos(tilt) of the rod against the vertical.
  [[nodiscard]] Scalar cosine() const { return cosine_; }

 private:
  Slopes<Scalar> slopes_;
  Scalar excess_;  ///< 1/cos(tilt) - 1
  Scalar cosine_;
};

/// Whether a vertical beam at a sensor meets the plane within the disc (method.md eq. 12).
template <class Scalar>
[[nodiscard]] bool beam_meets_disc(const SensorLayout<Scalar>& layout, std::size_t sensor,
                                   Scalar gap_m, Scalar disc_diameter_m) {
  const Vector3<Scalar>& face = layout.position_m[sensor];
  const Vector3<Scalar> spot(face.x(), face.y(), face.z() - gap_m);
  // The spot lies in the plane, so Pythagoras takes the pivot's distance out.
  return spot.squaredNorm() - layout.disc_offset_m * layout.disc_offset_m <=
         disc_diameter_m * disc_diameter_m / 4;
}

}  // namespace penduline
