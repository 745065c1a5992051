// SPDX-License-Identifier: Apache-2.0
#include "host/analysis/swing_ellipse.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>

using namespace penduline;

namespace {

constexpr double kPeriodS = 1.1;

/// A small ellipse of known axes, drifting slowly, with noise on both angles.
AngleSeries small_ellipse(double noise_rad, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0, noise_rad > 0 ? noise_rad : 1);
  AngleSeries series;
  for (int i = 0; i < 400; ++i) {
    const double t_s = 0.05 * i;
    const double phase = 2 * std::numbers::pi * t_s / kPeriodS + 0.7;
    const double along = 0.010 * std::exp(-0.01 * t_s) * std::cos(phase);
    const double across = 0.004 * std::sin(phase);
    const double turn = 0.5 + 0.02 * t_s;
    const double x = along * std::cos(turn) - across * std::sin(turn);
    const double y = along * std::sin(turn) + across * std::cos(turn);
    series.t_s.push_back(t_s);
    series.theta1_rad.push_back(std::asin(y) + (noise_rad > 0 ? noise(random) : 0));
    series.theta2_rad.push_back(std::asin(-x) + (noise_rad > 0 ? noise(random) : 0));
  }
  return series;
}

SwingCut about_rest(double noise_rad) {
  return {.period_s = kPeriodS,
          .step_s = kPeriodS,
          .rest = TiltPoint{},
          .noise = TiltPoint{.x_rad = noise_rad, .y_rad = noise_rad}};
}

}  // namespace

TEST_CASE("The tilt's point has the tilt's size and the rod's direction") {
  const TiltPoint to_x = tilt_point(0, -0.3);
  CHECK(to_x.x_rad == Approx(0.3));
  CHECK(to_x.y_rad == 0);
  const TiltPoint oblique = tilt_point(0.4, 0.2);
  CHECK(std::hypot(oblique.x_rad, oblique.y_rad) ==
        Approx(std::acos(std::cos(0.4) * std::cos(0.2))));
  CHECK(oblique.y_rad / oblique.x_rad == Approx(-std::sin(0.4) / std::tan(0.2)));
}

TEST_CASE("Axes, orientation, phase and sense come back, swing by swing") {
  const auto ellipses = swing_ellipses(small_ellipse(0), about_rest(1e-4));
  REQUIRE(ellipses.size() == 18);
  for (const SwingEllipse& ellipse : ellipses) {
    CHECK(ellipse.semi_major_rad.value ==
          Approx(0.010 * std::exp(-0.01 * ellipse.t_s)).epsilon(2e-3));
    CHECK(ellipse.semi_minor_rad.value == Approx(0.004).epsilon(2e-3));
    CHECK(ellipse.orientation_rad.value == Approx(0.5 + 0.02 * ellipse.t_s).margin(2e-3));
    const double phase = 2 * std::numbers::pi * ellipse.t_s / kPeriodS + 0.7;
    CHECK(std::remainder(ellipse.phase_rad.value - phase, 2 * std::numbers::pi) ==
          Approx(0).margin(2e-3));
  }
}

TEST_CASE("The ellipses' sigmas are what they scatter by") {
  constexpr double kNoiseRad = 5e-4;
  double squares_axis = 0;
  double squares_angle = 0;
  constexpr int kSeeds = 100;
  std::size_t count = 0;
  for (unsigned seed = 1; seed <= kSeeds; ++seed) {
    for (const SwingEllipse& ellipse :
         swing_ellipses(small_ellipse(kNoiseRad, seed), about_rest(kNoiseRad))) {
      const double axis = ellipse.semi_major_rad.value - 0.010 * std::exp(-0.01 * ellipse.t_s);
      const double angle = ellipse.orientation_rad.value - 0.5 - 0.02 * ellipse.t_s;
      squares_axis += std::pow(axis / ellipse.semi_major_rad.sigma, 2);
      squares_angle += std::pow(angle / ellipse.orientation_rad.sigma, 2);
      ++count;
    }
  }
  // 1800 swings: chi-square over its degrees of freedom is within 9 % of 1 at 99 %.
  CHECK(squares_axis / static_cast<double>(count) == Approx(1).margin(0.09));
  CHECK(squares_angle / static_cast<double>(count) == Approx(1).margin(0.09));
}

TEST_CASE("Without a rest given each swing finds its centre") {
  AngleSeries series = small_ellipse(0);
  for (double& angle : series.theta1_rad) {
    angle += 0.003;
  }
  const auto ellipses =
      swing_ellipses(series, {.period_s = kPeriodS, .step_s = kPeriodS, .rest = {}, .noise = {}});
  for (const SwingEllipse& ellipse : ellipses) {
    CHECK(ellipse.centre.y_rad == Approx(0.003).margin(2e-5));
    CHECK(ellipse.semi_minor_rad.value == Approx(0.004).epsilon(1e-2));
  }
}

TEST_CASE("A piece that lacks samples has no ellipse") {
  const AngleSeries whole = small_ellipse(0);
  AngleSeries series = whole.between(0, 5);
  const AngleSeries rest = whole.between(8, 20);
  series.t_s.insert(series.t_s.end(), rest.t_s.begin(), rest.t_s.end());
  series.theta1_rad.insert(series.theta1_rad.end(), rest.theta1_rad.begin(), rest.theta1_rad.end());
  series.theta2_rad.insert(series.theta2_rad.end(), rest.theta2_rad.begin(), rest.theta2_rad.end());
  for (const SwingEllipse& ellipse : swing_ellipses(series, about_rest(1e-4))) {
    CHECK((ellipse.t_s < 5 || ellipse.t_s > 8));
    CHECK(ellipse.semi_minor_rad.value == Approx(0.004).epsilon(5e-3));
  }
}
