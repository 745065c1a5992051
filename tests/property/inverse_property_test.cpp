// SPDX-License-Identifier: Apache-2.0
// Properties of the inverse: whatever the layout, it undoes the forward model in the good region.
#include <rapidcheck/catch.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <utility>

#include "common/gauss_newton.hpp"
#include "tests/property/generators.hpp"
#include "tests/unit/common/test_rig.hpp"

namespace penduline::test {
namespace {

/// Conditioning at a tilt: 1 - u . p, with u the level part of the rod's direction and
/// p = lp (sum place place^T)^-1 (sum place); for the paper's two sensors 1 - (a/dx + b/dy) lp.
double conditioning_at(const SensorLayout<double>& layout, const Angles<double>& angles) {
  Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; i < layout.count; ++i) {
    const Eigen::Vector2d place = layout.position_m[i].head<2>();
    spread += place * place.transpose();
    sum += place;
  }
  return 1 - layout.disc_offset_m * rod_at(angles).head<2>().dot(spread.inverse() * sum);
}

/// A tilt in the layout's good region: to 45 degrees in any direction, conditioning 0.3 or more.
Angles<double> good_tilt(const SensorLayout<double>& layout) {
  const auto tilt =
      rc::gen::map(rc::gen::pair(in_steps(0, 1), in_steps(-std::numbers::pi, std::numbers::pi)),
                   [](const std::pair<double, double>& slope) {
                     return angles_of(Slopes<double>{.a = slope.first * std::cos(slope.second),
                                                     .b = slope.first * std::sin(slope.second)});
                   });
  return *rc::gen::suchThat(
      tilt, [&](const Angles<double>& angles) { return conditioning_at(layout, angles) >= 0.3; });
}

TEST_CASE("The inverse undoes the forward model for any sensible layout", "[property]") {
  rc::prop("angles come back to 1e-12 rad", [] {
    const auto layout = *any_layout();
    const Angles<double> angles = good_tilt(layout);
    const auto result = GaussNewton<double>(layout).solve(gaps_at(layout, angles));
    RC_ASSERT(result.has_value());
    RC_ASSERT(angle_error(result->slopes, angles) <= 1e-12);
  });
}

TEST_CASE("Conditioning is the same for any layout by its formula", "[property]") {
  rc::prop("conditioning is 1 - u . p", [] {
    const auto layout = *any_layout();
    const Angles<double> angles = good_tilt(layout);
    const auto result = GaussNewton<double>(layout).solve(gaps_at(layout, angles));
    RC_ASSERT(result.has_value());
    RC_ASSERT(std::abs(result->conditioning - conditioning_at(layout, angles)) <= 1e-11);
  });
}

TEST_CASE("In float the inverse loses no more than its rounding for any sensible layout",
          "[property]") {
  rc::prop("float is near double on the same gaps", [] {
    const auto layout = rounded_layout(*any_layout());
    const auto wide = widened(layout);
    const Angles<double> angles = good_tilt(wide);
    const auto gap_m = rounded<float>(gaps_at(wide, angles));
    const auto result = GaussNewton<float>(layout).solve(gap_m);
    const auto expected = GaussNewton<double>(wide).solve(rounded<double>(gap_m));
    RC_ASSERT(result.has_value());
    RC_ASSERT(expected.has_value());
    // Gaps of up to 10 cm are sums good to 1e-8 m; places are 2 cm out at least.
    RC_ASSERT(angle_error(result->slopes, angles_of(expected->slopes)) <= 5e-6);
  });
}

TEST_CASE("With any small errors the answer is no worse than its neighbours", "[property]") {
  rc::prop("the squared misfit is least at the answer", [] {
    const auto layout = *any_layout();
    const Angles<double> angles = good_tilt(layout);
    auto gap_m = gaps_at(layout, angles);
    for (std::size_t i = 0; i < layout.count; ++i) {
      gap_m[i] += *in_steps(-100e-6, 100e-6);
    }
    const auto result = GaussNewton<double>(layout).solve(gap_m);
    RC_PRE(result.has_value());
    const auto misfit_m = [&](double a, double b) {
      const auto fitted_m = gaps_at(layout, angles_of(Slopes<double>{a, b}));
      double squares = 0;
      for (std::size_t i = 0; i < layout.count; ++i) {
        squares += (gap_m[i] - fitted_m[i]) * (gap_m[i] - fitted_m[i]);
      }
      return std::sqrt(squares / static_cast<double>(layout.count));
    };
    const double least_m = misfit_m(result->slopes.a, result->slopes.b);
    constexpr double kStep = 1e-5;
    for (const auto& [da, db] :
         {std::pair{kStep, 0.0}, {-kStep, 0.0}, {0.0, kStep}, {0.0, -kStep}}) {
      RC_ASSERT(misfit_m(result->slopes.a + da, result->slopes.b + db) >= least_m - 1e-16);
    }
    RC_ASSERT(std::abs(result->residual_m - least_m) <= 1e-12);
  });
}

}  // namespace
}  // namespace penduline::test
