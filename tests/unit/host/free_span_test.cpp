// SPDX-License-Identifier: Apache-2.0
#include "host/analysis/free_span.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>

using namespace penduline;

namespace {

/// 60 s at 20 Hz of what `angle_rad` says of theta1, with noise on both angles.
AngleSeries series_of(const std::function<double(double)>& angle_rad) {
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0, 1e-3);
  AngleSeries series;
  for (int i = 0; i < 1200; ++i) {
    const double t_s = 0.05 * i;
    series.t_s.push_back(t_s);
    series.theta1_rad.push_back(angle_rad(t_s) + noise(random));
    series.theta2_rad.push_back(noise(random));
  }
  return series;
}

double swing(double t_s) {
  return 0.17 * std::exp(-0.02 * t_s) * std::cos(2 * std::numbers::pi * t_s / 1.1);
}

}  // namespace

TEST_CASE("The free swing between a hand and a standstill is found") {
  const auto span = find_free_span(series_of([](double t_s) {
    return t_s < 4 ? 0.17 : t_s < 40 ? swing(t_s - 4) : 0;
  }));
  REQUIRE(span);
  CHECK(span->period_s == Approx(1.1).epsilon(0.03));
  CHECK(span->from_s >= 4);
  CHECK(span->from_s < 5.7);
  CHECK(span->to_s <= 40);
  CHECK(span->to_s > 38.3);
}

TEST_CASE("A series that swings throughout is free throughout") {
  const auto span = find_free_span(series_of(swing));
  REQUIRE(span);
  CHECK(span->from_s == Approx(0).margin(0.1));
  CHECK(span->to_s > 58.5);
}

TEST_CASE("A push ends one free swing and begins another, and the longer is taken") {
  const auto span = find_free_span(
      series_of([](double t_s) { return t_s < 20 ? swing(t_s + 20) : 2 * swing(t_s); }));
  REQUIRE(span);
  CHECK(span->from_s >= 19.5);
  CHECK(span->from_s < 23);
}

TEST_CASE("A swing that somebody drives is not free") {
  const auto span = find_free_span(series_of([](double t_s) {
    return 0.03 * std::exp(0.05 * t_s) * std::cos(2 * std::numbers::pi * t_s / 1.1);
  }));
  REQUIRE_FALSE(span);
  CHECK(span.error().message.find("held, pushed or at rest") != std::string::npos);
}

TEST_CASE("A pendulum at rest has no free swing") {
  const auto span = find_free_span(series_of([](double) { return 0.05; }));
  REQUIRE_FALSE(span);
  CHECK(span.error().message.find("found ") == 0);
}

TEST_CASE("A short glimpse is refused with what was found") {
  const auto span = find_free_span(series_of(swing).between(0, 2));
  REQUIRE_FALSE(span);
  CHECK(span.error().message.find("expected at least 3 swings") != std::string::npos);
}

TEST_CASE("Nothing at all is no swing") {
  CHECK(strongest_period_s({}) == 0);
  CHECK_FALSE(find_free_span({}));
}

TEST_CASE("The strongest period is that of the swing, not of a slow hand") {
  const double period_s = strongest_period_s(
      series_of([](double t_s) { return 0.2 * std::sin(0.3 * t_s) + 0.3 * swing(t_s); }));
  CHECK(period_s == Approx(1.1).epsilon(0.03));
}
