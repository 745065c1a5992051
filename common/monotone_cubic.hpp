// SPDX-License-Identifier: Apache-2.0
// A monotone cubic through given points, and its inverse: no overshoot between the points.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include "common/bisection.hpp"

namespace penduline {

/// The most points that a curve may have.
inline constexpr std::size_t kMaxCurvePoints = 32;

/// Piecewise cubic Hermite interpolation that is monotone where its points are: the slopes of
/// Fritsch and Butland (1984), as in MATLAB's and SciPy's `pchip`. Beyond the end points it goes on
/// as a straight line with the end's slope; the caller says when such a value may be used.
template <class Scalar>
class MonotoneCubic {
 public:
  /// `x` strictly ascending, `y` strictly monotone, both of the same size 2..kMaxCurvePoints.
  MonotoneCubic(std::span<const Scalar> x, std::span<const Scalar> y) : count_(x.size()) {
    std::ranges::copy(x, x_.begin());
    std::ranges::copy(y, y_.begin());
    if (count_ == 2) {
      slope_[0] = slope_[1] = secant(0);
      return;
    }
    for (std::size_t i = 1; i + 1 < count_; ++i) {
      slope_[i] = interior_slope(width(i - 1), width(i), secant(i - 1), secant(i));
    }
    slope_[0] = end_slope(width(0), width(1), secant(0), secant(1));
    slope_[count_ - 1] =
        end_slope(width(count_ - 2), width(count_ - 3), secant(count_ - 2), secant(count_ - 3));
  }

  [[nodiscard]] std::span<const Scalar> x() const { return {x_.data(), count_}; }
  [[nodiscard]] std::span<const Scalar> y() const { return {y_.data(), count_}; }

  /// The curve's value at `x`.
  [[nodiscard]] Scalar operator()(Scalar x) const {
    if (x <= x_[0]) {
      return y_[0] + slope_[0] * (x - x_[0]);
    }
    if (x >= x_[count_ - 1]) {
      return y_[count_ - 1] + slope_[count_ - 1] * (x - x_[count_ - 1]);
    }
    return value_in(segment_of(x), x);
  }

  /// The curve's slope at `x`.
  [[nodiscard]] Scalar slope(Scalar x) const {
    if (x <= x_[0]) {
      return slope_[0];
    }
    if (x >= x_[count_ - 1]) {
      return slope_[count_ - 1];
    }
    return slope_in(segment_of(x), x);
  }

  /// The x at which the curve is `y`: bisection to the last bit of the segment's cubic.
  [[nodiscard]] Scalar inverse(Scalar y) const {
    const bool rising = y_[count_ - 1] > y_[0];
    const auto beyond = [&](std::size_t i) { return rising ? y_[i] > y : y_[i] < y; };
    if (beyond(0)) {
      return x_[0] + (y - y_[0]) / slope_[0];
    }
    if (!beyond(count_ - 1)) {
      return x_[count_ - 1] + (y - y_[count_ - 1]) / slope_[count_ - 1];
    }
    std::size_t segment = 0;
    while (!beyond(segment + 1)) {
      ++segment;
    }
    return bisect(x_[segment], x_[segment + 1],
                  [&](Scalar x) { return (value_in(segment, x) > y) == rising; });
  }

 private:
  [[nodiscard]] Scalar width(std::size_t i) const { return x_[i + 1] - x_[i]; }
  [[nodiscard]] Scalar secant(std::size_t i) const { return (y_[i + 1] - y_[i]) / width(i); }

  /// The segment of an x between the end points.
  [[nodiscard]] std::size_t segment_of(Scalar x) const {
    const Scalar* above = std::upper_bound(x_.data() + 1, x_.data() + count_ - 1, x);
    return static_cast<std::size_t>(above - x_.data()) - 1;
  }

  [[nodiscard]] Scalar quadratic(std::size_t i) const {
    return (3 * secant(i) - 2 * slope_[i] - slope_[i + 1]) / width(i);
  }
  [[nodiscard]] Scalar cubic(std::size_t i) const {
    return (slope_[i] + slope_[i + 1] - 2 * secant(i)) / (width(i) * width(i));
  }

  [[nodiscard]] Scalar value_in(std::size_t i, Scalar x) const {
    const Scalar t = x - x_[i];
    return y_[i] + t * (slope_[i] + t * (quadratic(i) + t * cubic(i)));
  }
  [[nodiscard]] Scalar slope_in(std::size_t i, Scalar x) const {
    const Scalar t = x - x_[i];
    return slope_[i] + t * (2 * quadratic(i) + t * 3 * cubic(i));
  }

  /// Weighted harmonic mean of the secants on both sides.
  [[nodiscard]] static Scalar interior_slope(Scalar width_before, Scalar width_after,
                                             Scalar secant_before, Scalar secant_after) {
    const Scalar weight_before = 2 * width_after + width_before;
    const Scalar weight_after = width_after + 2 * width_before;
    return (weight_before + weight_after) /
           (weight_before / secant_before + weight_after / secant_after);
  }

  /// Three-point formula at an end, limited so that the end segment stays monotone.
  [[nodiscard]] static Scalar end_slope(Scalar width_near, Scalar width_far, Scalar secant_near,
                                        Scalar secant_far) {
    const Scalar slope = ((2 * width_near + width_far) * secant_near - width_near * secant_far) /
                         (width_near + width_far);
    // Where the formula would turn round, SciPy makes the end flat; the sensor's curve must keep an
    // inverse there, so the secant stands in.
    return slope * secant_near <= 0 ? secant_near : slope;
  }

  std::array<Scalar, kMaxCurvePoints> x_{};
  std::array<Scalar, kMaxCurvePoints> y_{};
  std::array<Scalar, kMaxCurvePoints> slope_{};
  std::size_t count_;
};

}  // namespace penduline
