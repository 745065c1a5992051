// SPDX-License-Identifier: Apache-2.0
// Tests of the paper's chains: the transform against NumPy, Eqs. 22 and 23, agreement with the
// plane.
#include "common/denavit_hartenberg.hpp"

#include <Eigen/LU>
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/unit/common/test_rig.hpp"

namespace penduline::test {
namespace {

constexpr double kDiscOffset = 0.02;

// float: lengths of up to 0.1 m through four rotations, each good to 6e-8.
template <class Scalar>
constexpr double kTolerance = tolerance<Scalar>(2e-16, 1e-7);

/// Every 4 degrees of both angles to +-80 degrees.
template <class Visitor>
void for_each_angle(const Visitor& visit) {
  for (int i = -80; i <= 80; i += 4) {
    for (int j = -80; j <= 80; j += 4) {
      visit(Angles<double>{from_degrees(i), from_degrees(j)});
    }
  }
}

template <class Scalar>
Angles<Scalar> narrow(const Angles<double>& angles) {
  return {static_cast<Scalar>(angles.theta1_rad), static_cast<Scalar>(angles.theta2_rad)};
}

/// Eq. 22 as reading.md writes it.
Vector3<double> eq_22(const Angles<double>& angles, double lp, double l1, double l2) {
  const double s1 = std::sin(angles.theta1_rad);
  const double c1 = std::cos(angles.theta1_rad);
  const double s2 = std::sin(angles.theta2_rad);
  const double c2 = std::cos(angles.theta2_rad);
  return {-lp * s2 + l2 * c2, l2 * s1 * s2 - l1 * c1 + lp * s1 * c2,
          -l2 * c1 * s2 - l1 * s1 - lp * c1 * c2};
}

/// Eq. 23 as reading.md writes it.
Vector3<double> eq_23(const Angles<double>& angles, double lp, double l3, double l4) {
  const double s1 = std::sin(angles.theta1_rad);
  const double c1 = std::cos(angles.theta1_rad);
  const double s2 = std::sin(angles.theta2_rad);
  const double c2 = std::cos(angles.theta2_rad);
  return {-lp * s2 + l4 * c2, l3 * c1 + lp * s1 * c2 + l4 * s1 * s2,
          -l4 * c1 * s2 + l3 * s1 - lp * c1 * c2};
}

template <class Scalar>
Transform<double> x_chain(const Angles<double>& angles, double l1, double l2) {
  return sensor_x_chain(narrow<Scalar>(angles), static_cast<Scalar>(kDiscOffset),
                        static_cast<Scalar>(l1), static_cast<Scalar>(l2))
      .template cast<double>();
}

template <class Scalar>
Transform<double> y_chain(const Angles<double>& angles, double l3, double l4) {
  return sensor_y_chain(narrow<Scalar>(angles), static_cast<Scalar>(kDiscOffset),
                        static_cast<Scalar>(l3), static_cast<Scalar>(l4))
      .template cast<double>();
}

/// How far the rotation part is from a rotation: columns not orthonormal, or turned inside out.
double rotation_error(const Transform<double>& transform) {
  const Eigen::Matrix3d rotation = transform.topLeftCorner<3, 3>();
  Worst worst;
  worst.note((rotation.transpose() * rotation - Eigen::Matrix3d::Identity()).norm());
  worst.note(rotation.determinant() - 1);
  return worst.value();
}

TEMPLATE_TEST_CASE("A row's transform is NumPy's product of its four motions",
                   "[denavit_hartenberg]", float, double) {
  // numpy: Rz(0.7) @ Tz(-0.3) @ Tx(1.25) @ Rx(-1.1)
  Transform<double> expected;
  expected << 0.7648421872844886, -0.29221464428477223, -0.574131544347986, 0.9560527341056108,  //
      0.644217687237691, 0.34692944965489897, 0.681632986593423, 0.8052721090471138,             //
      0, -0.8912073600614353, 0.45359612142557726, -0.3,                                         //
      0, 0, 0, 1;
  const auto transform =
      dh_transform<TestType>({TestType(0.7), TestType(-0.3), TestType(1.25), TestType(-1.1)});
  const double error = (transform.template cast<double>() - expected).cwiseAbs().maxCoeff();
  CHECK(error <= tolerance<TestType>(3e-16, 2e-7));
}

TEMPLATE_TEST_CASE("A row of zeros moves nothing", "[denavit_hartenberg]", float, double) {
  CHECK(dh_transform(DhRow<TestType>{}) == Transform<TestType>::Identity());
}

TEMPLATE_TEST_CASE("The chain of Sx ends where Eq. 22 says", "[denavit_hartenberg]", float,
                   double) {
  Worst worst;
  for_each_angle([&](const Angles<double>& angles) {
    const Vector3<double> end =
        x_chain<TestType>(angles, 0.007, -0.05).template topRightCorner<3, 1>();
    worst.note((end - eq_22(angles, kDiscOffset, 0.007, -0.05)).norm());
  });
  CHECK(worst.value() <= kTolerance<TestType>);
}

TEMPLATE_TEST_CASE("The chain of Sy ends where Eq. 23 says", "[denavit_hartenberg]", float,
                   double) {
  Worst worst;
  for_each_angle([&](const Angles<double>& angles) {
    const Vector3<double> end =
        y_chain<TestType>(angles, 0.007, -0.05).template topRightCorner<3, 1>();
    worst.note((end - eq_23(angles, kDiscOffset, 0.007, -0.05)).norm());
  });
  CHECK(worst.value() <= kTolerance<TestType>);
}

TEMPLATE_TEST_CASE("Both chains turn without stretching or mirroring", "[denavit_hartenberg]",
                   float, double) {
  Worst worst;
  for_each_angle([&](const Angles<double>& angles) {
    worst.note(rotation_error(x_chain<TestType>(angles, 0.007, -0.05)));
    worst.note(rotation_error(y_chain<TestType>(angles, 0.007, -0.05)));
  });
  CHECK(worst.value() <= tolerance<TestType>(2e-15, 1e-6));
}

TEST_CASE("Seen from Sx, the spot on the disc is under the sensor at the plane's gap",
          "[denavit_hartenberg]") {
  constexpr double kDx = 0.02;
  Worst worst;
  for_each_angle([&](const Angles<double>& angles) {
    // The first two rows of Eq. 22 = (dx, 0), linear in l2, then in l1.
    const double tan2 = std::tan(angles.theta2_rad);
    const double l2 = kDx / std::cos(angles.theta2_rad) + kDiscOffset * tan2;
    const double l1 = std::tan(angles.theta1_rad) * (l2 * std::sin(angles.theta2_rad) +
                                                     kDiscOffset * std::cos(angles.theta2_rad));
    const Vector3<double> spot = x_chain<double>(angles, l1, l2).topRightCorner<3, 1>();
    const double gap_m = DiscPlane<double>(slopes_of(angles))
                             .gap_m(layout_of<double>({{kDx, 0, 0}}, kDiscOffset), 0);
    worst.note((spot - Vector3<double>(kDx, 0, -gap_m)).norm() / (gap_m + kDx));
  });
  CHECK(worst.value() <= 1e-14);
}

TEST_CASE("Seen from Sy, the spot on the disc is under the sensor at the plane's gap",
          "[denavit_hartenberg]") {
  constexpr double kDy = 0.02;
  Worst worst;
  for_each_angle([&](const Angles<double>& angles) {
    // The first two rows of Eq. 23 = (0, dy), linear in l4, then in l3.
    const double l4 = kDiscOffset * std::tan(angles.theta2_rad);
    const double l3 = kDy / std::cos(angles.theta1_rad) -
                      std::tan(angles.theta1_rad) * (kDiscOffset * std::cos(angles.theta2_rad) +
                                                     l4 * std::sin(angles.theta2_rad));
    const Vector3<double> spot = y_chain<double>(angles, l3, l4).topRightCorner<3, 1>();
    const double gap_m = DiscPlane<double>(slopes_of(angles))
                             .gap_m(layout_of<double>({{0, kDy, 0}}, kDiscOffset), 0);
    worst.note((spot - Vector3<double>(0, kDy, -gap_m)).norm() / (std::abs(gap_m) + kDy));
  });
  CHECK(worst.value() <= 1e-14);
}

}  // namespace
}  // namespace penduline::test
