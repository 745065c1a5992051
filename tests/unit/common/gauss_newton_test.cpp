// SPDX-License-Identifier: Apache-2.0
// Tests of Gauss-Newton: the paper's layout over the whole good region, sensors far out, no answer.
#include "common/gauss_newton.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "tests/unit/common/test_rig.hpp"

namespace penduline::test {
namespace {

/// Visits every degree of tilt to 75 degrees, past which a float's rounding passes the bar.
template <class Visitor>
void for_each_large_tilt(const Visitor& visit) {
  for (int i = -75; i <= 75; ++i) {
    for (int j = -75; j <= 75; ++j) {
      const Angles<double> angles{from_degrees(i), from_degrees(j)};
      if (-rod_at(angles).z() >= std::cos(from_degrees(75))) {
        visit(angles);
      }
    }
  }
}

/// So far out that there is no singular line.
template <class Scalar>
SensorLayout<Scalar> wide_layout() {
  return layout_of<Scalar>({{0.05, 0, 0}, {0, 0.05, 0}}, 0.02);
}

TEST_CASE("Gauss-Newton gives the angles back to 1e-12 rad over the whole good region",
          "[gauss_newton]") {
  const auto layout = paper_layout<double>();
  const GaussNewton<double> inverse(layout);
  Worst worst;
  for_each_good_tilt([&](const Angles<double>& angles) {
    const auto result = inverse.solve(gaps_at(layout, angles));
    REQUIRE(result.has_value());
    worst.note(angle_error(result->slopes, angles));
  });
  CHECK(worst.value() <= 1e-12);
}

TEST_CASE("In float Gauss-Newton is within 5e-7 rad of the closed form in double on the same gaps",
          "[gauss_newton]") {
  const auto layout = paper_layout<float>();
  const GaussNewton<float> inverse(layout);
  const ClosedForm<double> reference(widened(layout));
  Worst worst;
  for_each_good_tilt([&](const Angles<double>& angles) {
    const auto gap_m = rounded<float>(gaps_at(widened(layout), angles));
    const auto result = inverse.solve(gap_m);
    REQUIRE(result.has_value());
    const auto expected = reference.solve(rises_of(widened(layout), rounded<double>(gap_m)));
    worst.note(angle_error(result->slopes, angles_of(expected->slopes)));
  });
  CHECK(worst.value() <= 5e-7);
}

TEMPLATE_TEST_CASE("Over the good region the conditioning is never below its bar", "[gauss_newton]",
                   float, double) {
  const auto layout = paper_layout<TestType>();
  const GaussNewton<TestType> inverse(layout);
  double least = 1;
  for_each_good_tilt([&](const Angles<double>& angles) {
    const auto result = inverse.solve(rounded<TestType>(gaps_at(widened(layout), angles)));
    least = std::min(least, double{result->conditioning});
  });
  CHECK(least >= double{kLeastConditioning<TestType>} - tolerance<TestType>(1e-14, 1e-6));
}

TEMPLATE_TEST_CASE("Two sensors leave no misfit but rounding", "[gauss_newton]", float, double) {
  const auto layout = paper_layout<TestType>();
  const GaussNewton<TestType> inverse(layout);
  Worst worst;
  for_each_good_tilt([&](const Angles<double>& angles) {
    const auto result = inverse.solve(rounded<TestType>(gaps_at(widened(layout), angles)));
    worst.note(double{result->residual_m});
  });
  CHECK(worst.value() <= tolerance<TestType>(1e-18, 1e-10));
}

TEST_CASE("Sensors far out give tilts to 75 degrees back", "[gauss_newton]") {
  const auto layout = wide_layout<double>();
  const GaussNewton<double> inverse(layout);
  Worst worst;
  for_each_large_tilt([&](const Angles<double>& angles) {
    const auto result = inverse.solve(gaps_at(layout, angles));
    REQUIRE(result.has_value());
    worst.note(angle_error(result->slopes, angles));
  });
  CHECK(worst.value() <= 1e-12);
}

TEST_CASE("In float sensors far out are within 5e-7 rad of double for tilts to 75 degrees",
          "[gauss_newton]") {
  Worst worst;
  for_each_large_tilt(
      [&](const Angles<double>& angles) { worst.note(float_error(wide_layout<float>(), angles)); });
  CHECK(worst.value() <= 5e-7);
}

TEST_CASE("Two sensors at different heights give the angles back", "[gauss_newton]") {
  const auto layout = layout_of<double>({{0.02, 0, 0.004}, {0, 0.02, -0.003}}, 0.02);
  const Angles<double> angles{from_degrees(-14), from_degrees(9)};
  const auto result = GaussNewton<double>(layout).solve(gaps_at(layout, angles));
  REQUIRE(result.has_value());
  CHECK(angle_error(result->slopes, angles) <= 1e-12);
}

TEMPLATE_TEST_CASE("Impossible gaps have no answer", "[gauss_newton]", float, double) {
  const std::array<TestType, 2> touching{};
  CHECK_FALSE(GaussNewton<TestType>(paper_layout<TestType>()).solve(touching).has_value());
}

TEMPLATE_TEST_CASE("Gaps too large for the scalar have no answer", "[gauss_newton]", float,
                   double) {
  const TestType largest = std::numeric_limits<TestType>::max();
  const TestType infinity = std::numeric_limits<TestType>::infinity();
  for (const TestType gap : {largest, -largest, infinity, -infinity}) {
    CAPTURE(gap);
    const std::array<TestType, 2> gap_m = {gap, TestType(0.02)};
    CHECK_FALSE(GaussNewton<TestType>(paper_layout<TestType>()).solve(gap_m).has_value());
    CHECK_FALSE(GaussNewton<TestType>(wide_layout<TestType>()).solve(gap_m).has_value());
  }
}

TEMPLATE_TEST_CASE("Slopes too steep for their squares are no answer", "[gauss_newton]", float,
                   double) {
  // Here the closed form's numbers stay finite, but 1 + a^2 + b^2 does not: the rod would vanish.
  const TestType far = TestType(-0.0435) * std::sqrt(std::numeric_limits<TestType>::max());
  const std::array<TestType, 2> gap_m = {far, TestType(0.02)};
  const auto result = GaussNewton<TestType>(wide_layout<TestType>()).solve(gap_m);
  CHECK((!result || DiscPlane<TestType>(result->slopes).rod().norm() > TestType(0.5)));
}

}  // namespace
}  // namespace penduline::test
