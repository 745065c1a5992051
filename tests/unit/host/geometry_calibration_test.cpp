// SPDX-License-Identifier: Apache-2.0
#include "host/calibration/geometry_calibration.hpp"

#include <catch2/catch.hpp>

#include "tests/accuracy/simulated_unit.hpp"

using namespace penduline;
using namespace penduline::test;

namespace {

/// The typical rig with sensors and disc somewhere else than its file says.
Rig<double> displaced() {
  Rig<double> rig = typical_rig().rig;
  rig.layout.position_m[0] = {0.0207, 0.0006, -0.0108};
  rig.layout.position_m[1] = {-0.0004, 0.0192, -0.0113};
  rig.layout.disc_offset_m = 0.0203;
  return rig;
}

std::vector<Angles<double>> grid(bool both) {
  std::vector<Angles<double>> tilts;
  for (int i = -3; i <= 3; ++i) {
    for (int k = -3; k <= 3; ++k) {
      tilts.push_back(
          {.theta1_rad = 4 * i * kRadPerDeg, .theta2_rad = both ? 4 * k * kRadPerDeg : 0});
    }
  }
  return tilts;
}

SensorPoints seen(const std::vector<Angles<double>>& tilts) {
  return held_points(displaced(), typical_rig().rig, tilts, 0, 1);
}

}  // namespace

TEST_CASE("Known tilts on all sides tell where the sensors stand", "[calibration]") {
  const auto result = calibrate_geometry(typical_rig(), seen(grid(true)));
  REQUIRE(result);
  const SensorLayout<double> found = changed(typical_rig().rig, result->changes).layout;
  for (std::size_t i = 0; i < 2; ++i) {
    const Vector3<double> off = found.position_m[i] - displaced().layout.position_m[i];
    CHECK(off.head<2>().norm() < 1e-4);
    CHECK(off.z() + found.disc_offset_m == Approx(0.0203).margin(2e-5));
  }
  CHECK(found.disc_offset_m == Approx(0.0203).margin(5e-4));
  CHECK(result->record.not_determined.empty());
}

TEST_CASE("Tilts about one axis tell nothing across it: that stays, and is said", "[calibration]") {
  const auto result = calibrate_geometry(typical_rig(), seen(grid(false)));
  REQUIRE(result);
  CHECK(result->record.not_determined == std::vector<std::string>{"Sx x_m", "Sy x_m"});
  const SensorLayout<double> found = changed(typical_rig().rig, result->changes).layout;
  CHECK(found.position_m[0].x() == 0.02);
  CHECK(found.position_m[1].y() == Approx(0.0192).margin(1e-4));
}

TEST_CASE("One tilt tells the gaps at rest only", "[calibration]") {
  const auto result = calibrate_geometry(typical_rig(), seen({{.theta1_rad = 0, .theta2_rad = 0}}));
  REQUIRE(result);
  CHECK(result->record.not_determined ==
        std::vector<std::string>{"disc offset_m", "Sx y_m", "Sx x_m", "Sy x_m", "Sy y_m"});
  CHECK(result->record.parameters == std::vector<std::string>{"Sx rest_gap_m", "Sy rest_gap_m"});
}

TEST_CASE("Responses that are wrong do not become a geometry", "[calibration]") {
  SensorPoints points = seen(grid(true));
  for (std::size_t i = 0; i < points[0].size(); ++i) {
    points[0][i].volts *= i % 2 == 0 ? 1.15 : 0.87;
  }
  const auto result = calibrate_geometry(typical_rig(), points);
  REQUIRE_FALSE(result);
  CHECK(result.error().message.find("calibrate the responses by known gaps first") !=
        std::string::npos);
}

TEST_CASE("Known gaps tell nothing of where a sensor stands", "[calibration]") {
  SensorPoints points = seen(grid(true));
  points[0][0].angles = std::nullopt;
  const auto result = calibrate_geometry(typical_rig(), points);
  REQUIRE_FALSE(result);
  CHECK(result.error().message ==
        "points.csv: found gaps, expected theta1_deg and theta2_deg: gaps tell nothing of where a "
        "sensor stands");
}

TEST_CASE("Samples of a swing beyond a response's range are left out, counted and warned of",
          "[calibration]") {
  RigFile rig = typical_rig();
  rig.rig.responses[0].farthest_m = 0.0125;
  const auto result = calibrate_geometry(rig, {recorded(displaced(), ellipse(20, 1))}, {});
  REQUIRE(result);
  REQUIRE(result->warnings.size() == 1);
  const std::string& warning = result->warnings.front();
  INFO(warning);
  const auto of = warning.find(
      " of 400 samples are left out: they are without a sound reading, off "
      "the disc, or not at 3.00 to 12.50 mm, where its response holds");
  REQUIRE(of != std::string::npos);
  CHECK(warning.starts_with("sensor Sx: "));
  CHECK(std::stoi(warning.substr(11)) > 10);
  CHECK(std::stoi(warning.substr(11)) < 100);
}

TEST_CASE("A swing of which a sensor's response holds for half is no geometry", "[calibration]") {
  RigFile rig = typical_rig();
  rig.rig.responses[0].farthest_m = 0.0095;
  const auto result = calibrate_geometry(rig, {recorded(displaced(), ellipse(20, 1))}, {});
  REQUIRE_FALSE(result);
  INFO(result.error().message);
  CHECK(result.error().message.starts_with("rec.csv: sensor Sx: "));
  CHECK(result.error().message.find("expected 25 % or less") != std::string::npos);
}

TEST_CASE("A swing through the fold is no geometry", "[calibration]") {
  const auto swing = settings_for({.theta_rad = 30 * kRadPerDeg}, 20, 1);
  const auto result = calibrate_geometry(typical_rig(), {recorded(displaced(), swing)}, {});
  REQUIRE_FALSE(result);
  CHECK(
      result.error().message.find("% of the samples are at the fold of its response or beside it, "
                                  "nearer than 3.00 mm") != std::string::npos);
}

TEST_CASE("A free swing tells the geometry but for a turn about the vertical", "[calibration]") {
  const auto result =
      calibrate_geometry(typical_rig(), {recorded(displaced(), ellipse(20, 1))}, {});
  REQUIRE(result);
  CHECK(result->record.not_determined.front() == "Sx y_m");
  const SensorLayout<double> found = changed(typical_rig().rig, result->changes).layout;
  CHECK(found.position_m[0].head<2>().norm() == Approx(0.0207).margin(3e-4));
  CHECK(found.position_m[1].head<2>().norm() == Approx(0.0192).margin(3e-4));
}
