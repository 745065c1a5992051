// SPDX-License-Identifier: Apache-2.0
// Tests of the monotone cubic: against SciPy's PCHIP, its inverse, its ends and what lies beyond.
#include "common/monotone_cubic.hpp"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "tests/unit/common/test_rig.hpp"

namespace penduline::test {
namespace {

template <class Scalar>
MonotoneCubic<Scalar> curve_through(std::span<const double> x, std::span<const double> y) {
  const auto narrow = [](double value) { return static_cast<Scalar>(value); };
  std::vector<Scalar> xs(x.size());
  std::vector<Scalar> ys(y.size());
  std::ranges::transform(x, xs.begin(), narrow);
  std::ranges::transform(y, ys.begin(), narrow);
  return {xs, ys};
}

/// A falling curve such as a reflectance sensor has beyond its peak: metres over volts.
constexpr std::array kVolts = {0.31, 0.42, 0.55, 0.8, 1.3, 2.1};
constexpr std::array kGaps = {0.026, 0.020, 0.016, 0.0115, 0.0082, 0.0031};

/// A rising curve with a steep middle, whose ends SciPy makes flat.
constexpr std::array kSteepX = {-2.0, -1.0, -0.5, 0.0, 0.25, 3.0};
constexpr std::array kSteepY = {-4.0, -3.5, 0.0, 0.1, 2.0, 2.5};

template <class Scalar>
MonotoneCubic<Scalar> sensor_curve() {
  return curve_through<Scalar>(kVolts, kGaps);
}

/// sqrt(1 + i) over i / 10, as many points as a curve may have.
MonotoneCubic<double> longest_curve() {
  std::array<double, kMaxCurvePoints> x{};
  std::array<double, kMaxCurvePoints> y{};
  for (std::size_t i = 0; i < kMaxCurvePoints; ++i) {
    x[i] = 0.1 * static_cast<double>(i);
    y[i] = std::sqrt(1.0 + static_cast<double>(i));
  }
  return {x, y};
}

TEMPLATE_TEST_CASE("A falling curve is SciPy's PCHIP", "[monotone_cubic]", float, double) {
  constexpr std::array kX = {0.31,  0.315, 0.34, 0.37, 0.41, 0.42, 0.45, 0.5,
                             0.549, 0.55,  0.6,  0.7,  0.79, 0.8,  0.9,  1.05,
                             1.2,   1.3,   1.31, 1.5,  1.75, 2.0,  2.09, 2.1};
  // scipy.interpolate.PchipInterpolator(volts, gaps)(x)
  constexpr std::array kExpected = {0.026,
                                    0.02567439516284106,
                                    0.024102091499464618,
                                    0.02237061336404617,
                                    0.020413355520818192,
                                    0.02,
                                    0.01887977950689346,
                                    0.01729299305279906,
                                    0.0160234024706583,
                                    0.016,
                                    0.0148660495055977,
                                    0.01289002284348399,
                                    0.011605900251210027,
                                    0.0115,
                                    0.010609004533774329,
                                    0.009619459674341687,
                                    0.008795903849383032,
                                    0.0082,
                                    0.008135070406045043,
                                    0.006906396349921229,
                                    0.005305648407331518,
                                    0.0037255951579517436,
                                    0.0031623850684309516,
                                    0.0031000000000000003};
  const auto curve = sensor_curve<TestType>();
  Worst worst;
  for (std::size_t i = 0; i < kX.size(); ++i) {
    worst.note(double{curve(static_cast<TestType>(kX[i]))} - kExpected[i]);
  }
  // float: rounding of 0.026 (2e-9) and of the volts (3e-8 V at up to 65 mm/V).
  CHECK(worst.value() <= tolerance<TestType>(1e-16, 5e-9));
}

TEMPLATE_TEST_CASE("A rising curve with a steep middle is SciPy's PCHIP between its inner points",
                   "[monotone_cubic]", float, double) {
  constexpr std::array kX = {-1.0, -0.9, -0.6, -0.5, -0.3, -0.1, 0.0, 0.05, 0.2, 0.25};
  // scipy.interpolate.PchipInterpolator(steep_x, steep_y)(x)
  constexpr std::array kExpected = {
      -3.5, -3.0761238615664848, -0.3723642987249538, 0.0, 0.04228789808917197, 0.06793941967445151,
      0.1,  0.30767699449422437, 1.7904277231998273,  2.0};
  const auto curve = curve_through<TestType>(kSteepX, kSteepY);
  Worst worst;
  for (std::size_t i = 0; i < kX.size(); ++i) {
    worst.note(double{curve(static_cast<TestType>(kX[i]))} - kExpected[i]);
  }
  CHECK(worst.value() <= tolerance<TestType>(1e-14, 5e-6));
}

TEST_CASE("The longest curve is SciPy's PCHIP", "[monotone_cubic]") {
  constexpr std::array kX = {0.05, 0.73, 1.55, 2.22, 3.07};
  // scipy.interpolate.PchipInterpolator(0.1 * i, sqrt(1 + i))(x), i = 0..31
  constexpr std::array kExpected = {1.2199468322627534, 2.8809904275047145, 4.062019874062206,
                                    4.816639070737285, 5.630279049971382};
  const auto curve = longest_curve();
  Worst worst;
  for (std::size_t i = 0; i < kX.size(); ++i) {
    worst.note(curve(kX[i]) - kExpected[i]);
  }
  CHECK(worst.value() <= 1e-14);
}

TEMPLATE_TEST_CASE("A curve meets its points exactly", "[monotone_cubic]", float, double) {
  const auto curve = sensor_curve<TestType>();
  for (std::size_t i = 0; i < kVolts.size(); ++i) {
    CAPTURE(i);
    CHECK(curve(static_cast<TestType>(kVolts[i])) == static_cast<TestType>(kGaps[i]));
  }
}

TEMPLATE_TEST_CASE("Two points give the straight line through them", "[monotone_cubic]", float,
                   double) {
  const auto line = curve_through<TestType>(std::array{1.0, 3.0}, std::array{-2.0, 2.0});
  for (const double x : {-1.0, 1.0, 1.25, 2.0, 3.0, 5.0}) {
    CHECK_THAT(line(static_cast<TestType>(x)),
               Catch::WithinAbs(2 * x - 4, tolerance<TestType>(1e-15, 5e-7)));
  }
}

TEMPLATE_TEST_CASE("Beyond its ends a curve goes on straight with SciPy's end slopes",
                   "[monotone_cubic]", float, double) {
  const auto curve = sensor_curve<TestType>();
  // PchipInterpolator(volts, gaps)([0.31, 2.1], 1)
  const double before = 0.026 + 0.1 * 0.06544289044289044;
  const double after = 0.0031 - 0.4 * 0.006236538461538464;
  const double bar = tolerance<TestType>(1e-16, 5e-9);
  CHECK_THAT(curve(TestType(0.21)), Catch::WithinAbs(before, bar));
  CHECK_THAT(curve(TestType(2.5)), Catch::WithinAbs(after, bar));
}

TEST_CASE("An end that SciPy makes flat keeps the slope of its segment, to have an inverse",
          "[monotone_cubic]") {
  const auto curve = curve_through<double>(kSteepX, kSteepY);
  CHECK_THAT(curve(-3.0), Catch::WithinAbs(-4.5, 1e-14));
  CHECK_THAT(curve(14.0), Catch::WithinAbs(4.5, 1e-14));
}

TEMPLATE_TEST_CASE("The inverse of a falling curve gives x back", "[monotone_cubic]", float,
                   double) {
  const auto curve = sensor_curve<TestType>();
  Worst worst;
  for (int i = -200; i <= 1200; ++i) {
    const auto x = static_cast<TestType>(0.31 + 1.79 * i / 1000);
    worst.note(double{curve.inverse(curve(x)) - x});
  }
  // The value's own rounding (of 0.026 or of the sums behind it) over the least slope, 6 mm/V.
  CHECK(worst.value() <= tolerance<TestType>(3e-15, 1.5e-6));
}

TEMPLATE_TEST_CASE("The inverse of a rising curve gives x back", "[monotone_cubic]", float,
                   double) {
  const auto curve = curve_through<TestType>(kSteepX, kSteepY);
  Worst worst;
  for (int i = -200; i <= 1200; ++i) {
    const auto x = static_cast<TestType>(-2 + 5.0 * i / 1000);
    // In y, since near x = -0.25 and 2.9 the curve is almost level.
    worst.note(double{curve(curve.inverse(curve(x))) - curve(x)});
  }
  CHECK(worst.value() <= tolerance<TestType>(5e-15, 3e-6));
}

TEST_CASE("The inverse meets the points exactly", "[monotone_cubic]") {
  const auto curve = sensor_curve<double>();
  for (std::size_t i = 0; i < kVolts.size(); ++i) {
    CAPTURE(i);
    CHECK_THAT(curve.inverse(kGaps[i]), Catch::WithinULP(kVolts[i], 1));
  }
}

TEST_CASE("A curve keeps the points that it was made from", "[monotone_cubic]") {
  const auto curve = sensor_curve<double>();
  CHECK(std::ranges::equal(curve.x(), kVolts));
  CHECK(std::ranges::equal(curve.y(), kGaps));
}

TEST_CASE("Between two points a steep curve stays between their values", "[monotone_cubic]") {
  const auto curve = curve_through<double>(kSteepX, kSteepY);
  for (std::size_t segment = 0; segment + 1 < kSteepX.size(); ++segment) {
    for (int i = 1; i < 1000; ++i) {
      const double x = std::lerp(kSteepX[segment], kSteepX[segment + 1], i / 1000.0);
      CAPTURE(segment, x);
      REQUIRE(curve(x) > kSteepY[segment]);
      REQUIRE(curve(x) < kSteepY[segment + 1]);
    }
  }
}

}  // namespace
}  // namespace penduline::test
