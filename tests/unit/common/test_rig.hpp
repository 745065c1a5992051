// SPDX-License-Identifier: Apache-2.0
// What the tests of common share: layouts, gaps by a route of their own, samples of a paper-like
// rig.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <numbers>
#include <span>
#include <type_traits>

#include "common/disc_plane.hpp"
#include "common/gauss_newton.hpp"
#include "common/rig.hpp"
#include "common/sample.hpp"

namespace penduline::test {

/// The bar of a check that runs for both scalars.
template <class Scalar>
[[nodiscard]] constexpr double tolerance(double for_double, double for_float) {
  return std::is_same_v<Scalar, double> ? for_double : for_float;
}

[[nodiscard]] constexpr double from_degrees(double degrees) {
  return degrees * std::numbers::pi / 180;
}

/// Keeps the largest error that it is told; a NaN is larger than any number.
class Worst {
 public:
  void note(double error) {
    if (!(std::abs(error) <= value_) && !std::isnan(value_)) {
      value_ = std::abs(error);
    }
  }
  [[nodiscard]] double value() const { return value_; }

 private:
  double value_ = 0;
};

template <class Scalar>
[[nodiscard]] SensorLayout<Scalar> layout_of(std::initializer_list<Vector3<double>> positions_m,
                                             double disc_offset_m) {
  SensorLayout<Scalar> layout{.disc_offset_m = static_cast<Scalar>(disc_offset_m)};
  for (const Vector3<double>& position_m : positions_m) {
    layout.position_m[layout.count++] = position_m.cast<Scalar>();
  }
  return layout;
}

/// The paper's: lp = 2 cm, one sensor 2 cm along X, one 2 cm along Y.
template <class Scalar>
[[nodiscard]] SensorLayout<Scalar> paper_layout() {
  return layout_of<Scalar>({{0.02, 0, 0}, {0, 0.02, 0}}, 0.02);
}

/// The same numbers, rounded as they are, in double.
template <class Scalar>
[[nodiscard]] SensorLayout<double> widened(const SensorLayout<Scalar>& layout) {
  SensorLayout<double> wide{.count = layout.count, .disc_offset_m = layout.disc_offset_m};
  for (std::size_t i = 0; i < layout.count; ++i) {
    wide.position_m[i] = layout.position_m[i].template cast<double>();
  }
  return wide;
}

/// The rod's direction as reading.md writes it.
[[nodiscard]] inline Vector3<double> rod_at(const Angles<double>& angles) {
  return {-std::sin(angles.theta2_rad), std::sin(angles.theta1_rad) * std::cos(angles.theta2_rad),
          -std::cos(angles.theta1_rad) * std::cos(angles.theta2_rad)};
}

/// The gap of each sensor where its beam meets the plane rod . p = lp: no slopes, no DiscPlane.
[[nodiscard]] inline std::array<double, kMaxSensors> gaps_at(const SensorLayout<double>& layout,
                                                             const Angles<double>& angles) {
  const Vector3<double> rod = rod_at(angles);
  std::array<double, kMaxSensors> gap_m{};
  for (std::size_t i = 0; i < layout.count; ++i) {
    const Vector3<double>& face = layout.position_m[i];
    gap_m[i] =
        face.z() - (layout.disc_offset_m - rod.x() * face.x() - rod.y() * face.y()) / rod.z();
  }
  return gap_m;
}

/// The values in another scalar.
template <class Scalar, class From>
[[nodiscard]] std::array<Scalar, kMaxSensors> rounded(const std::array<From, kMaxSensors>& values) {
  std::array<Scalar, kMaxSensors> result{};
  std::ranges::transform(values, result.begin(),
                         [](From value) { return static_cast<Scalar>(value); });
  return result;
}

/// What the closed form wants: rest gap less gap.
template <class Scalar>
[[nodiscard]] std::array<Scalar, kMaxSensors> rises_of(
    const SensorLayout<Scalar>& layout, const std::array<Scalar, kMaxSensors>& gap_m) {
  std::array<Scalar, kMaxSensors> rise_m{};
  for (std::size_t i = 0; i < layout.count; ++i) {
    rise_m[i] = layout.position_m[i].z() + layout.disc_offset_m - gap_m[i];
  }
  return rise_m;
}

/// The larger of the two angles' differences.
template <class Scalar, class Reference>
[[nodiscard]] double angle_error(const Slopes<Scalar>& slopes, const Angles<Reference>& expected) {
  const Angles<double> found =
      angles_of(Slopes<double>{.a = double{slopes.a}, .b = double{slopes.b}});
  Worst worst;
  worst.note(found.theta1_rad - double{expected.theta1_rad});
  worst.note(found.theta2_rad - double{expected.theta2_rad});
  return worst.value();
}

/// Conditioning of the paper's layout as reading.md has it: 1 - (a/dx + b/dy) lp.
[[nodiscard]] inline double paper_conditioning(const Angles<double>& angles) {
  const Vector3<double> rod = rod_at(angles);
  return 1 - (rod.x() / 0.02 + rod.y() / 0.02) * 0.02;
}

/// Visits every half degree of the paper's good region: conditioning >= 0.3, tilt <= 45 degrees.
template <class Visitor>
void for_each_good_tilt(const Visitor& visit) {
  for (int i = -90; i <= 90; ++i) {
    for (int j = -90; j <= 90; ++j) {
      const Angles<double> angles{from_degrees(i / 2.0), from_degrees(j / 2.0)};
      if (paper_conditioning(angles) >= 0.3 && -rod_at(angles).z() >= std::sqrt(0.5)) {
        visit(angles);
      }
    }
  }
}

/// Gauss-Newton in float against the same in double, on the same gaps rounded to float.
[[nodiscard]] inline double float_error(const SensorLayout<float>& layout,
                                        const Angles<double>& angles) {
  const auto gap_m = rounded<float>(gaps_at(widened(layout), angles));
  const auto result = GaussNewton<float>(layout).solve(gap_m);
  const auto reference = GaussNewton<double>(widened(layout)).solve(rounded<double>(gap_m));
  if (!result || !reference) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  return angle_error(result->slopes, angles_of(reference->slopes));
}

/// design.md's rig with two linear sensors, or three of them 120 degrees apart.
inline constexpr double kGapAtZero = 0.031;
inline constexpr double kSlope = -0.006;

template <class Scalar>
[[nodiscard]] Rig<Scalar> linear_rig(const SensorLayout<Scalar>& layout) {
  Rig<Scalar> rig;
  rig.layout = layout;
  rig.filter = FilterDesign<Scalar>{15, Scalar(0.15)};
  for (std::size_t i = 0; i < layout.count; ++i) {
    rig.responses[i].model =
        LinearResponse<Scalar>{.gap_at_zero_m = static_cast<Scalar>(kGapAtZero),
                               .slope_m_per_v = static_cast<Scalar>(kSlope)};
  }
  return rig;
}

template <class Scalar>
[[nodiscard]] SensorLayout<Scalar> three_sensor_layout() {
  const double across = 0.02 * std::numbers::sqrt3 / 2;
  return layout_of<Scalar>({{0.02, 0, 0}, {-0.01, across, 0}, {-0.01, -across, 0}}, 0.02);
}

/// A sample of a linear rig at 20 Hz whose counts mean the gaps, to half a count.
[[nodiscard]] inline Sample sample_of(std::uint64_t seq,
                                      const std::array<double, kMaxSensors>& gap_m) {
  Sample sample{.seq = seq, .t_us = static_cast<std::int64_t>(seq + 1) * 50'000};
  for (std::size_t i = 0; i < kMaxSensors; ++i) {
    const double volts = (gap_m[i] - kGapAtZero) / kSlope;
    sample.readings[i].on = static_cast<std::int32_t>(std::lround(volts / 3.3 * 65535));
  }
  return sample;
}

}  // namespace penduline::test
