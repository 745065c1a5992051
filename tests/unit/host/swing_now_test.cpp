// SPDX-License-Identifier: Apache-2.0
// Tests of the figures of the last seconds.
#include "host/web/swing_now.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>

namespace {

using namespace penduline;

constexpr Pendulum<double> kPendulum{.length_m = 0.5};
constexpr double kPeriodS = 1.42;

/// 60 s at 20 Hz of an ellipse of these half axes, turned by `orientation_rad`, with noise.
std::deque<LiveRow> swinging(double a_rad, double b_rad, double orientation_rad,
                             double noise_rad = 3e-4) {
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0, noise_rad);
  std::deque<LiveRow> rows;
  for (int i = 0; i < 1200; ++i) {
    const double t_s = 0.05 * i;
    const double phase = 2 * std::numbers::pi * t_s / kPeriodS;
    const double along = a_rad * std::cos(phase);
    const double across = b_rad * std::sin(phase);
    const double x = along * std::cos(orientation_rad) - across * std::sin(orientation_rad);
    const double y = along * std::sin(orientation_rad) + across * std::cos(orientation_rad);
    const double theta2 = std::asin(-x);
    rows.push_back({.t_s = t_s,
                    .theta1_rad = std::asin(y / std::cos(theta2)) + noise(random),
                    .theta2_rad = theta2 + noise(random)});
  }
  return rows;
}

TEST_CASE("Period, amplitude and ellipse of a swing are found within a per cent", "[web]") {
  const auto swing = swing_now(swinging(0.1, 0.03, 0.6), kPendulum);
  REQUIRE(swing);
  CHECK(swing->period_s == Approx(kPeriodS).epsilon(0.002));
  CHECK(swing->amplitude_rad == Approx(0.1).epsilon(0.01));
  CHECK(swing->ellipse.a_m == Approx(0.05).epsilon(0.01));
  CHECK(swing->ellipse.b_m == Approx(0.015).epsilon(0.03));
  CHECK(swing->ellipse.orientation_rad == Approx(0.6).margin(0.01));
  CHECK(swing->ellipse.x_m == Approx(0).margin(1e-4));
  CHECK(swing->ellipse.sense == 1);
}

TEST_CASE("A circle has a period, too, whichever way it goes", "[web]") {
  CHECK(swing_now(swinging(0.1, 0.1, 0), kPendulum)->period_s == Approx(kPeriodS).epsilon(0.002));
  CHECK(swing_now(swinging(0.1, -0.1, 0), kPendulum)->period_s == Approx(kPeriodS).epsilon(0.002));
}

TEST_CASE("A path's axis is within a quarter turn of X, its centre where the pendulum rests",
          "[web]") {
  SwingEllipse swing;
  swing.semi_major_rad = {.value = 0.1};
  swing.semi_minor_rad = {.value = -0.02, .sigma = 0.008};
  swing.orientation_rad = {.value = std::numbers::pi - 0.5};
  swing.centre = {.x_rad = 0.01, .y_rad = -0.02};
  const PathEllipse path = path_of(swing, kPendulum.length_m);
  CHECK(path.orientation_rad == Approx(-0.5));
  CHECK(path.b_m == Approx(kPendulum.length_m * std::sin(0.02)));
  CHECK(path.x_m == Approx(kPendulum.length_m * std::sin(0.01)));
  CHECK(path.y_m == Approx(-kPendulum.length_m * std::sin(0.02)));
  CHECK(path.sense == 0);  // 2.5 sigmas
}

TEST_CASE("The other way round is the other sense", "[web]") {
  CHECK(swing_now(swinging(0.1, -0.03, 0.6), kPendulum)->ellipse.sense == -1);
}

TEST_CASE("A plane swing has no sense", "[web]") {
  CHECK(swing_now(swinging(0.1, 0, 0.6), kPendulum)->ellipse.sense == 0);
}

TEST_CASE("An orientation is the axis', within a quarter turn of X", "[web]") {
  CHECK(swing_now(swinging(0.1, 0.03, -0.6), kPendulum)->ellipse.orientation_rad ==
        Approx(-0.6).margin(0.01));
}

TEST_CASE("At rest there is no swing, whatever the noise", "[web]") {
  CHECK_FALSE(swing_now(swinging(0, 0, 0), kPendulum));
}

TEST_CASE("What is too fast for the pendulum is noise", "[web]") {
  CHECK_FALSE(swing_now(swinging(0.1, 0.03, 0.6), Pendulum<double>{.length_m = 5}));
}

TEST_CASE("A swing that the angles' uncertainty hides is not told", "[web]") {
  auto rows = swinging(0.01, 0.003, 0.6, 1e-5);
  rows.back().sigma1_rad = rows.back().sigma2_rad = 0.003;
  CHECK(swing_now(rows, kPendulum));
  rows.back().sigma2_rad = 0.004;
  CHECK_FALSE(swing_now(rows, kPendulum));
}

TEST_CASE("Too few rows, or none that can be trusted, are no swing", "[web]") {
  CHECK_FALSE(swing_now({}, kPendulum));
  auto rows = swinging(0.1, 0.03, 0.6);
  for (LiveRow& row : rows) {
    row.flags = flag::kDisturbed;
  }
  CHECK_FALSE(swing_now(rows, kPendulum));
  rows.resize(10);
  CHECK_FALSE(swing_now(rows, kPendulum));
}

}  // namespace
