// SPDX-License-Identifier: Apache-2.0
#include "host/fit/swing_path.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

using penduline::swing_path;

namespace {

constexpr std::array<double, 8> kTimesS = {0, 0.5, 1, 2, 3, 4, 6, 8};

}  // namespace

// scipy.integrate.solve_ivp(method="DOP853", rtol=1e-12, atol=1e-14), each half swing by itself
// from where the rate is 0, until the pull is below the dry friction.
TEST_CASE("A plane swing with all three frictions moves and stops as SciPy integrates it") {
  constexpr std::array<double, 8> kThetaRad = {0.1,          -0.060023846, -0.007034493,
                                               -0.053863951, 0.012893304,  0.019572532,
                                               -0.000435882, -0.000435882};
  const auto path =
      swing_path({.stiffness_1_s2 = 64,
                  .friction = {.linear_per_s = 0.05, .quadratic_per_rad = 0.3, .dry_rad_s2 = 0.18}},
                 {.theta1_rad = 0.1}, kTimesS);
  for (std::size_t i = 0; i < kTimesS.size(); ++i) {
    // What the rounding of dry friction costs.
    CHECK(path[i].theta1_rad == Approx(kThetaRad[i]).margin(5e-5));
    CHECK(path[i].theta2_rad == 0);
  }
  CHECK(path.back().omega1_rad_s == 0);
}

TEST_CASE("A plane swing without dry friction moves as SciPy integrates it") {
  constexpr std::array<double, 8> kThetaRad = {0.1,          -0.062630844, -0.011317550,
                                               -0.076520272, 0.028762513,  0.055403666,
                                               -0.036484145, 0.019941777};
  const auto path =
      swing_path({.stiffness_1_s2 = 64,
                  .friction = {.linear_per_s = 0.05, .quadratic_per_rad = 0.3, .dry_rad_s2 = 0}},
                 {.theta1_rad = 0.1}, kTimesS);
  for (std::size_t i = 0; i < kTimesS.size(); ++i) {
    CHECK(path[i].theta1_rad == Approx(kThetaRad[i]).margin(1e-6));
  }
}

TEST_CASE("Dry friction takes the same off each half swing, in any direction") {
  // Of small swings 2 dry / stiffness.
  constexpr double kDryRadPerS2 = 0.02;
  constexpr double kStiffnessPerS2 = 25;
  std::vector<double> turns_s;
  for (int i = 0; i < 4; ++i) {
    turns_s.push_back(i * std::numbers::pi / 5);
  }
  const auto path =
      swing_path({.stiffness_1_s2 = kStiffnessPerS2, .friction = {.dry_rad_s2 = kDryRadPerS2}},
                 {.theta1_rad = 0.006, .theta2_rad = 0.008}, turns_s);
  for (std::size_t i = 0; i < path.size(); ++i) {
    const double left = 0.01 - static_cast<double>(i) * 2 * kDryRadPerS2 / kStiffnessPerS2;
    CHECK(std::hypot(path[i].theta1_rad, path[i].theta2_rad) == Approx(left).margin(2e-5));
  }
}

TEST_CASE("A mass that dry friction holds stays where it is") {
  const auto path = swing_path({.stiffness_1_s2 = 25, .friction = {.dry_rad_s2 = 0.02}},
                               {.theta1_rad = 7e-4}, kTimesS);
  for (const auto& state : path) {
    CHECK(state.theta1_rad == Approx(7e-4).margin(1e-6));
  }
}
