// SPDX-License-Identifier: Apache-2.0
// Tests of what an analysis says of a pendulum that comes to rest, and of a span with too few
// swings.
#include "host/analysis/swing_analysis.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>
#include <random>

#include "host/analysis/analysis_report.hpp"

using namespace penduline;

namespace {

/// A plane swing of 0.1 rad and a period of 1.1 s, its amplitude falling by 0.0078 rad/s.
AngleSeries dry_swing(double seconds) {
  std::mt19937 random(5);
  std::normal_distribution<double> noise(0, 2e-4);
  std::vector<double> times;
  for (int i = 0; i < 20 * seconds; ++i) {
    times.push_back(0.05 * i);
  }
  const SwingModel model{.swing = {.stiffness_1_s2 = std::pow(2 * 3.14159265358979 / 1.1, 2),
                                   .friction = {.dry_rad_s2 = 0.07}},
                         .start = {.theta1_rad = 0.1}};
  AngleSeries series = simulated_angles(model, times, true);
  for (double& angle : series.theta1_rad) {
    angle += noise(random);
  }
  return series;
}

std::string error_of(const AnalysisSettings& settings) {
  const auto analysis = analyze_swing(dry_swing(10), settings);
  return analysis ? "" : analysis.error().message;
}

}  // namespace

TEST_CASE("A pendulum that came to rest has no Q at the end, in words and in JSON") {
  const auto analysis = analyze_swing(dry_swing(20), {.from_s = 0});
  REQUIRE(analysis);
  CHECK(analysis->came_to_rest);
  CHECK(analysis_text(*analysis, "a.csv")
            .find("Q at the end              none: the pendulum came "
                  "to rest\n") != std::string::npos);
  const auto damping = nlohmann::json::parse(analysis_json(*analysis, "a.csv"))["damping"];
  CHECK(damping["came_to_rest"] == true);
  CHECK(damping["q_at_end"] == nlohmann::json{{"value", nullptr}, {"sigma", nullptr}});
  CHECK(damping["q_at_start"]["value"] > 0);
}

TEST_CASE("A pendulum that still swings at the end has a Q there, lower than at the start") {
  const auto analysis = analyze_swing(dry_swing(8), {});
  REQUIRE(analysis);
  CHECK_FALSE(analysis->came_to_rest);
  REQUIRE(analysis->quality_at_end);
  CHECK(analysis->quality_at_end->value < analysis->quality_at_start->value);
  const auto damping = nlohmann::json::parse(analysis_json(*analysis, "a.csv"))["damping"];
  CHECK(damping["came_to_rest"] == false);
  CHECK(damping["q_at_end"]["sigma"] > 0);
}

TEST_CASE("A span with too few swings is said in words where one end is not given") {
  CHECK(error_of({.to_s = 2}) ==
        "found 2 s of angles from the beginning to 2 s, expected at least 3 swings");
  CHECK(error_of({.from_s = 8}) ==
        "found 1.95 s of angles from 8 s to the end, expected at least 3 swings");
  CHECK(error_of({.from_s = 1, .to_s = 2}) ==
        "found 1 s of angles from 1 s to 2 s, expected at least 3 swings");
}
