// SPDX-License-Identifier: Apache-2.0
// The inverse for any number of sensors: Gauss-Newton in the disc's slopes, a fixed number of
// steps.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>

#include "common/closed_form.hpp"
#include "common/disc_plane.hpp"

namespace penduline {

/// What the inverse found.
template <class Scalar>
struct InverseResult {
  Slopes<Scalar> slopes;
  Scalar conditioning = 0;  ///< as in ClosedFormResult
  Scalar residual_m = 0;    ///< RMS of the gaps' misfit; rounding only for two sensors
};

/// Least-squares slopes from the gaps of two or more sensors (method.md eq. 11), from the closed
/// form on by analytic Gauss-Newton steps that also know the plane's curvature (method.md eq. 21).
/// Cold: the answer depends on the gaps alone.
template <class Scalar>
class GaussNewton {
 public:
  /// The sensors of `layout` must determine the tilt (`determines_tilt`).
  explicit GaussNewton(const SensorLayout<Scalar>& layout)
      : layout_(layout), closed_form_(layout), steps_(layout.count == 2 ? 1 : 3) {}

  /// Solves for one gap a sensor, in the layout's order; nothing where no tilt fits them.
  [[nodiscard]] std::optional<InverseResult<Scalar>> solve(std::span<const Scalar> gap_m) const {
    std::array<Scalar, kMaxSensors> rise_m{};
    for (std::size_t i = 0; i < layout_.count; ++i) {
      rise_m[i] = layout_.position_m[i].z() + layout_.disc_offset_m - gap_m[i];
    }
    const auto start = closed_form_.solve(rise_m);
    if (!start) {
      return std::nullopt;
    }
    Slopes<Scalar> slopes = start->slopes;
    Scalar squares = improve(slopes, DiscPlane<Scalar>(slopes, start->excess), rise_m);
    for (int step = 1; step < steps_; ++step) {
      squares = improve(slopes, DiscPlane<Scalar>(slopes), rise_m);
    }
    // The disc's plane and the residual are made of squares: a slope or a misfit may be finite and
    // its square not.
    if (!std::isfinite(slopes.a * slopes.a + slopes.b * slopes.b + squares)) {
      return std::nullopt;
    }
    return InverseResult<Scalar>{
        .slopes = slopes,
        .conditioning = start->conditioning,
        .residual_m = std::sqrt(squares / static_cast<Scalar>(layout_.count))};
  }

 private:
  /// One step from `slopes`, whose plane is given; returns the sum of the squared misfits that it
  /// started from, less what the step takes away.
  Scalar improve(Slopes<Scalar>& slopes, const DiscPlane<Scalar>& plane,
                 std::span<const Scalar> rise_m) const {
    Scalar h_aa = 0;
    Scalar h_ab = 0;
    Scalar h_bb = 0;
    Scalar g_a = 0;
    Scalar g_b = 0;
    Scalar squares = 0;
    Scalar misfits = 0;
    for (std::size_t i = 0; i < layout_.count; ++i) {
      const Vector3<Scalar>& face = layout_.position_m[i];
      const Scalar misfit = rise_m[i] - plane.rise_m(face.x(), face.y(), layout_.disc_offset_m);
      const Vector2<Scalar> gradient =
          plane.rise_gradient_m(face.x(), face.y(), layout_.disc_offset_m);
      h_aa += gradient.x() * gradient.x();
      h_ab += gradient.x() * gradient.y();
      h_bb += gradient.y() * gradient.y();
      g_a += gradient.x() * misfit;
      g_b += gradient.y() * misfit;
      squares += misfit * misfit;
      misfits += misfit;
    }
    // The plane's own curvature, the same under every sensor (method.md eq. 21).
    const Scalar cosine = plane.cosine();
    const Scalar bend = layout_.disc_offset_m * misfits * cosine;
    const Scalar a = slopes.a * cosine;
    const Scalar b = slopes.b * cosine;
    h_aa += bend * (1 - a * a);
    h_ab -= bend * a * b;
    h_bb += bend * (1 - b * b);
    const Scalar inverse_determinant = 1 / (h_aa * h_bb - h_ab * h_ab);
    const Scalar step_a = (h_bb * g_a - h_ab * g_b) * inverse_determinant;
    const Scalar step_b = (h_aa * g_b - h_ab * g_a) * inverse_determinant;
    slopes.a += step_a;
    slopes.b += step_b;
    return std::max(Scalar(0), squares - (step_a * g_a + step_b * g_b));
  }

  SensorLayout<Scalar> layout_;
  ClosedForm<Scalar> closed_form_;
  int steps_;
};

/// The answer of some of a layout's sensors alone: `gap_m` in the order of `sensors`, their places
/// in the layout. None where they do not determine the tilt.
template <class Scalar>
[[nodiscard]] std::optional<InverseResult<Scalar>> solve_with_some(
    const SensorLayout<Scalar>& layout, std::span<const std::size_t> sensors,
    std::span<const Scalar> gap_m) {
  SensorLayout<Scalar> some{.count = sensors.size(), .disc_offset_m = layout.disc_offset_m};
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    some.position_m[i] = layout.position_m[sensors[i]];
  }
  if (sensors.size() < 2 || !determines_tilt(some)) {
    return std::nullopt;
  }
  return GaussNewton<Scalar>(some).solve(gap_m);
}

}  // namespace penduline
