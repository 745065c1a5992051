// SPDX-License-Identifier: Apache-2.0
// Tests of the disc's plane: slopes and angles, gaps against NumPy, gradient, rod, edge of the
// disc.
#include "common/disc_plane.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "tests/unit/common/test_rig.hpp"

namespace penduline::test {
namespace {

template <class Scalar>
Angles<Scalar> angles_at(double theta1_deg, double theta2_deg) {
  return {static_cast<Scalar>(from_degrees(theta1_deg)),
          static_cast<Scalar>(from_degrees(theta2_deg))};
}

template <class Scalar>
DiscPlane<Scalar> plane_at(double theta1_deg, double theta2_deg) {
  return DiscPlane<Scalar>(slopes_of(angles_at<Scalar>(theta1_deg, theta2_deg)));
}

/// Every 5 degrees of both angles to +-85 degrees.
template <class Visitor>
void for_each_angle(const Visitor& visit) {
  for (int theta1 = -85; theta1 <= 85; theta1 += 5) {
    for (int theta2 = -85; theta2 <= 85; theta2 += 5) {
      visit(theta1, theta2);
    }
  }
}

TEMPLATE_TEST_CASE("Slopes are those of the plane with the rod as its normal", "[disc_plane]",
                   float, double) {
  // numpy: n = (-sin t2, sin t1 cos t2, -cos t1 cos t2), slopes (-n[0]/n[2], -n[1]/n[2])
  struct Case {
    double theta1_deg, theta2_deg, a, b;
  };
  const Case expected = GENERATE(Case{25, -40, 0.9258440048505814, 0.4663076581549987},
                                 Case{-10, 5, -0.08883831718254097, -0.176326980708465},
                                 Case{80, 10, -1.0154266118857447, 5.671281819617707});
  const auto slopes = slopes_of(angles_at<TestType>(expected.theta1_deg, expected.theta2_deg));
  // At 80 degrees the tangent makes 33 of the angle's rounding, 6e-8 in float.
  const double bar = tolerance<TestType>(1e-14, 5e-6);
  CHECK_THAT(slopes.a, Catch::WithinAbs(expected.a, bar));
  CHECK_THAT(slopes.b, Catch::WithinAbs(expected.b, bar));
}

TEMPLATE_TEST_CASE("Angles come back from their slopes", "[disc_plane]", float, double) {
  Worst worst;
  for_each_angle([&](int theta1, int theta2) {
    const auto angles = angles_at<TestType>(theta1, theta2);
    const auto back = angles_of(slopes_of(angles));
    worst.note(double{back.theta1_rad} - double{angles.theta1_rad});
    worst.note(double{back.theta2_rad} - double{angles.theta2_rad});
  });
  CHECK(worst.value() <= tolerance<TestType>(1e-15, 5e-7));
}

TEMPLATE_TEST_CASE("Gaps are those that NumPy finds where the beam meets the plane", "[disc_plane]",
                   float, double) {
  // numpy: n = Rx(t1) Ry(t2) (0, 0, -1), z from linalg.solve([n, ex, ey], [lp, x, y]), gap h - z
  struct Case {
    double theta1_deg, theta2_deg;
    Vector3<double> face;
    double disc_offset_m, gap_m;
  };
  const std::vector<Case> cases = {
      {0, 0, {0.02, 0, 0}, 0.02, 0.02},
      {10, 0, {0.02, 0, 0}, 0.02, 0.0203085322377149},
      {0, 10, {0.02, 0, 0}, 0.02, 0.0238350718518842},
      {10, -5, {0.02, 0, 0}, 0.02, 0.018609341187955986},
      {10, -5, {0, 0.02, 0}, 0.02, 0.01685956791743751},
      {-25, 40, {0.013, -0.031, 0.004}, 0.03, 0.044791162009310104},
      {-60, -30, {-0.02, 0.045, -0.002}, 0.015, 0.13367731325956198},
  };
  for (const Case& expected : cases) {
    CAPTURE(expected.theta1_deg, expected.theta2_deg);
    const auto plane = plane_at<TestType>(expected.theta1_deg, expected.theta2_deg);
    const auto layout = layout_of<TestType>({expected.face}, expected.disc_offset_m);
    CHECK_THAT(plane.gap_m(layout, 0),
               Catch::WithinAbs(expected.gap_m, tolerance<TestType>(1e-16, 4e-8)));
  }
}

TEMPLATE_TEST_CASE("The gap reads the sensor that is asked for", "[disc_plane]", float, double) {
  const auto layout = layout_of<TestType>({{0.02, 0, 0}, {0, 0.02, 0}, {0, 0, 0.25}}, 0.02);
  CHECK_THAT(plane_at<TestType>(0, 0).gap_m(layout, 2), Catch::WithinAbs(0.27, 1e-7));
}

TEMPLATE_TEST_CASE("Close to rest the rise keeps all its digits", "[disc_plane]", float, double) {
  const DiscPlane<TestType> plane(Slopes<TestType>{TestType(1e-4), TestType(2e-4)});
  // numpy: -0.02 * expm1(0.5 * log1p(1e-4**2 + 2e-4**2)), below the pivot
  const double rise_m = plane.rise_m(0, 0, TestType(0.02));
  CHECK(rise_m / -4.999999937500001e-10 - 1 == Approx(0).margin(tolerance<TestType>(1e-15, 4e-7)));
}

TEMPLATE_TEST_CASE("The rise's gradient is that of central differences", "[disc_plane]", float,
                   double) {
  constexpr double kX = 0.013;
  constexpr double kY = -0.031;
  constexpr double kOffset = 0.03;
  const auto rise_m = [&](double a, double b) {
    return DiscPlane<double>(Slopes<double>{a, b}).rise_m(kX, kY, kOffset);
  };
  Worst worst;
  for_each_angle([&](int theta1, int theta2) {
    const auto slopes = slopes_of(angles_at<double>(theta1, theta2));
    const double h = 1e-5 * (1 + std::abs(slopes.a) + std::abs(slopes.b));
    const DiscPlane<TestType> plane(
        Slopes<TestType>{static_cast<TestType>(slopes.a), static_cast<TestType>(slopes.b)});
    const auto gradient = plane.rise_gradient_m(
        static_cast<TestType>(kX), static_cast<TestType>(kY), static_cast<TestType>(kOffset));
    worst.note(gradient.x() -
               (rise_m(slopes.a + h, slopes.b) - rise_m(slopes.a - h, slopes.b)) / (2 * h));
    worst.note(gradient.y() -
               (rise_m(slopes.a, slopes.b + h) - rise_m(slopes.a, slopes.b - h)) / (2 * h));
  });
  // The differences are good to h^2 and to rounding over h, 1e-11; a float of 0.06 to 4e-9.
  CHECK(worst.value() <= tolerance<TestType>(2e-11, 1e-8));
}

TEMPLATE_TEST_CASE("The rod points as the angles say", "[disc_plane]", float, double) {
  Worst worst;
  for_each_angle([&](int theta1, int theta2) {
    const Vector3<double> expected = rod_at(angles_at<double>(theta1, theta2));
    const Vector3<double> rod = plane_at<TestType>(theta1, theta2).rod().template cast<double>();
    worst.note((rod - expected).norm());
  });
  CHECK(worst.value() <= tolerance<TestType>(1e-15, 5e-7));
}

TEMPLATE_TEST_CASE("At rest the rod hangs straight down", "[disc_plane]", float, double) {
  const DiscPlane<TestType> plane(Slopes<TestType>{});
  CHECK(plane.rod() == Vector3<TestType>(0, 0, -1));
  CHECK(plane.cosine() == 1);
}

TEMPLATE_TEST_CASE("The cosine is that of the tilt", "[disc_plane]", float, double) {
  // cos 25 deg * cos 40 deg in Python
  CHECK_THAT(plane_at<TestType>(25, -40).cosine(),
             Catch::WithinAbs(0.6942720440148838, tolerance<TestType>(1e-15, 1e-7)));
}

TEMPLATE_TEST_CASE("A beam on the disc's edge meets it, one just beyond does not", "[disc_plane]",
                   float, double) {
  // Powers of two, so that the edge is exact: a level disc of 12.5 cm, a beam 6.25 cm out.
  const auto at = [](double x_m) {
    return beam_meets_disc(layout_of<TestType>({{x_m, 0, 0}}, 0.015625), 0, TestType(0.015625),
                           TestType(0.125));
  };
  CHECK(at(0.0625));
  CHECK(at(-0.0625));
  CHECK_FALSE(at(0.0625 + 1.0 / 1048576));
}

TEMPLATE_TEST_CASE("On a tilted disc the edge is measured along the disc", "[disc_plane]", float,
                   double) {
  // numpy at 20, 30 deg: the spot's z as above, then norm(spot - lp n) = 0.058556352922586014
  const auto layout = layout_of<TestType>({{0.03, -0.02, 0.005}}, 0.02);
  const TestType gap_m = TestType(0.055287637323644945);
  CHECK(beam_meets_disc(layout, 0, gap_m, TestType(2 * 0.058557)));
  CHECK_FALSE(beam_meets_disc(layout, 0, gap_m, TestType(2 * 0.058556)));
}

}  // namespace
}  // namespace penduline::test
