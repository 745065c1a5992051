// SPDX-License-Identifier: Apache-2.0
// The inverse in closed form: exact for two sensors, the start of Gauss-Newton for any number.
#pragma once

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>

#include "common/disc_plane.hpp"

namespace penduline {

template <class Scalar>
using Matrix2 = Eigen::Matrix<Scalar, 2, 2>;

/// Sum over the sensors of place * place^T, in m^2: how well their places spread in X and Y.
template <class Scalar>
[[nodiscard]] Matrix2<Scalar> normal_matrix(const SensorLayout<Scalar>& layout) {
  Matrix2<Scalar> normal = Matrix2<Scalar>::Zero();
  for (std::size_t i = 0; i < layout.count; ++i) {
    const Vector2<Scalar> place = layout.position_m[i].template head<2>();
    normal += place * place.transpose();
  }
  return normal;
}

/// Whether the sensors' places can tell a tilt about X from one about Y: not all on one line
/// through the pivot. Their spread one way may be 100 times that across it, no more.
template <class Scalar>
[[nodiscard]] bool determines_tilt(const SensorLayout<Scalar>& layout) {
  const Matrix2<Scalar> normal = normal_matrix(layout);
  const Scalar trace = normal.trace();
  return trace > 0 && normal.determinant() > trace * trace * Scalar(1e-4);
}

/// The slopes that the closed form finds.
template <class Scalar>
struct ClosedFormResult {
  Slopes<Scalar> slopes;
  Scalar excess = 0;  ///< 1/cos(tilt) - 1, which belongs to them
  /// 1 at rest; 0 where two sensors cannot tell a tilt from its neighbours (method.md eq. 14).
  Scalar conditioning = 0;
};

/// Conditioning below which an answer is flagged: noise weighs three times what it does at rest.
template <class Scalar>
inline constexpr Scalar kLeastConditioning = Scalar(0.3);

/// Solves for the slopes by one quadratic equation: with the disc's excess e = 1/cos(tilt) - 1 held
/// fixed the slopes are linear in the gaps, and e must agree with the slopes that it leads to
/// (method.md eq. 13). Two sensors: exact. More: least squares for that e, off the best fit only by
/// the residual times the curvature.
template <class Scalar>
class ClosedForm {
 public:
  /// The sensors of `layout` must not stand on one line through the pivot (see `determines_tilt`).
  explicit ClosedForm(const SensorLayout<Scalar>& layout) : count_(layout.count) {
    const Matrix2<Scalar> inverse = normal_matrix(layout).inverse();
    for (std::size_t i = 0; i < count_; ++i) {
      to_slopes_[i] = inverse * layout.position_m[i].template head<2>();
      per_excess_ += layout.disc_offset_m * to_slopes_[i];
    }
    curvature_ = 1 - per_excess_.squaredNorm();
  }

  /// Slopes from the rises of the disc under each sensor (rest gap less gap), or nothing where no
  /// tilt fits: beyond the singular line the quadratic has no root.
  [[nodiscard]] std::optional<ClosedFormResult<Scalar>> solve(
      std::span<const Scalar> rise_m) const {
    Vector2<Scalar> flat = Vector2<Scalar>::Zero();
    for (std::size_t i = 0; i < count_; ++i) {
      flat += rise_m[i] * to_slopes_[i];
    }
    // curvature e^2 + 2 half_linear e - constant = 0, the root that is continuous with rest.
    const Scalar half_linear = 1 - flat.dot(per_excess_);
    const Scalar constant = flat.squaredNorm();
    const Scalar discriminant = half_linear * half_linear + curvature_ * constant;
    if (!(discriminant > 0) || (half_linear <= 0 && curvature_ <= 0)) {
      return std::nullopt;
    }
    const Scalar root = std::sqrt(discriminant);
    const Scalar excess =
        half_linear > 0 ? constant / (half_linear + root) : (root - half_linear) / curvature_;
    const Vector2<Scalar> slopes = flat + excess * per_excess_;
    return ClosedFormResult<Scalar>{.slopes = {.a = slopes.x(), .b = slopes.y()},
                                    .excess = excess,
                                    .conditioning = root / (1 + excess)};
  }

 private:
  /// Columns of the pseudo-inverse, in 1/m.
  std::array<Vector2<Scalar>, kMaxSensors> to_slopes_ = zero_vectors<Vector2<Scalar>>();
  Vector2<Scalar> per_excess_ = Vector2<Scalar>::Zero();  ///< change of the slopes with e
  Scalar curvature_;
  std::size_t count_;
};

}  // namespace penduline
