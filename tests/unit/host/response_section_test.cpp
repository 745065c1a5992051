// SPDX-License-Identifier: Apache-2.0
// Tests of the four response models in a rig file: what they read, what they refuse.
#include <array>
#include <catch2/catch.hpp>
#include <string>
#include <variant>

#include "host/rig_file.hpp"
#include "tests/unit/host/rig_text.hpp"

namespace {

using namespace penduline;
using namespace penduline::test;

Response<double> response(const std::string& table) {
  const auto file = parse_rig(rig_with_response(table), "rig.toml");
  if (!file) {
    throw std::runtime_error(file.error().message);
  }
  CHECK(file->complaints.empty());
  return file->rig.responses[0];
}

/// What stands behind "rig.toml:12: [[sensor]] 1 response ".
std::string response_error(const std::string& table) {
  constexpr std::string_view kPlace = "rig.toml:12: [[sensor]] 1 response ";
  const std::string error = rig_error(rig_with_response(table));
  return error.starts_with(kPlace) ? error.substr(kPlace.size()) : "elsewhere: " + error;
}

/// Vishay data sheet 83760, figure 9: a TCRT5000's relative current, gap by gap.
constexpr std::string_view kTcrt5000 =
    "{ model = \"table\", "
    "volts = [0.641, 0.833, 0.991, 1.000, 0.976, 0.889, 0.776, 0.663, 0.480, 0.355, 0.199], "
    "gap_m = [0.0005, 0.001, 0.002, 0.00236, 0.003, 0.004, 0.005, 0.006, 0.008, 0.010, 0.015] }";

TEST_CASE("A linear response reads its two numbers", "[rig]") {
  const auto sensor =
      response("{ model = \"linear\", gap_at_zero_m = 0.031, slope_m_per_v = -0.006 }");
  CHECK(sensor.read(1).gap_m == 0.031 - 0.006);
  CHECK(sensor.read(1).flags == 0);
}

TEST_CASE("An inverse square reads its three numbers", "[rig]") {
  const auto sensor =
      response("{ model = \"inverse_square\", a_v_m2 = 1e-4, b_m = 0.004, c_v = -0.25 }");
  // 1e-4 / (0.016 + 0.004)^2 - 0.25 = 0
  CHECK(sensor.read(0).gap_m.value() == Approx(0.016).epsilon(1e-12));
}

TEST_CASE("A polynomial reads its coefficients from the constant up and its range", "[rig]") {
  const auto sensor = response(
      "{ model = \"polynomial\", coefficients = [0.03, -0.01, 0.001], range_v = [0.5, 2] }");
  CHECK(sensor.read(1).gap_m.value() == Approx(0.021).epsilon(1e-12));
  CHECK(sensor.read(1).flags == 0);
  // 0.03 - 0.01 v + 0.001 v^2 at 0.5 V and 2 V
  CHECK(sensor.farthest_m == Approx(0.02525).epsilon(1e-12));
  CHECK(sensor.nearest_m == Approx(0.014).epsilon(1e-12));
}

TEST_CASE("A table goes through its points and holds between the outer ones", "[rig]") {
  const auto sensor =
      response("{ model = \"table\", volts = [0.31, 0.42, 0.55], gap_m = [0.026, 0.020, 0.016] }");
  CHECK(sensor.read(0.31).gap_m == 0.026);
  CHECK(sensor.read(0.55).gap_m == 0.016);
  CHECK(sensor.nearest_m == 0.016);
  CHECK(sensor.farthest_m == 0.026);
  CHECK(sensor.peak_m == 0);
  CHECK(sensor.read(0.56).flags == flag::kOutOfRange);
  CHECK(sensor.read(0.30).flags == flag::kOutOfRange);
}

TEST_CASE("A table's points may stand in any order", "[rig]") {
  const std::string table = GENERATE("volts = [0.55, 0.42, 0.31], gap_m = [0.016, 0.020, 0.026]",
                                     "volts = [0.42, 0.31, 0.55], gap_m = [0.020, 0.026, 0.016]");
  const auto sensor = response("{ model = \"table\", " + table + " }");
  const auto sorted =
      response("{ model = \"table\", volts = [0.31, 0.42, 0.55], gap_m = [0.026, 0.020, 0.016] }");
  for (const double volts : {0.31, 0.35, 0.42, 0.5, 0.55}) {
    CHECK(sensor.read(volts).gap_m == sorted.read(volts).gap_m);
  }
}

TEST_CASE("A table may have two points, in which case it is a line", "[rig]") {
  const auto sensor = response("{ model = \"table\", volts = [1, 2], gap_m = [0.02, 0.01] }");
  CHECK(sensor.read(1.5).gap_m.value() == Approx(0.015).epsilon(1e-12));
}

TEST_CASE("A table may rise with the gap", "[rig]") {
  const auto sensor =
      response("{ model = \"table\", volts = [1, 2, 4], gap_m = [0.01, 0.02, 0.03] }");
  CHECK(sensor.read(2).gap_m == 0.02);
  CHECK(sensor.peak_m == 0);
}

TEST_CASE("A folded table keeps the branch beyond its peak", "[rig]") {
  const auto sensor = response(std::string(kTcrt5000));
  CHECK(sensor.peak_m == 0.00236);
  CHECK(sensor.nearest_m == 0.00236);
  CHECK(sensor.farthest_m == 0.015);
  // 0.833 is also the current at 1 mm.
  CHECK(sensor.read(0.833).gap_m.value() > 0.004);
  CHECK(sensor.read(0.833).flags == 0);
}

TEST_CASE("A signal above a folded table's peak is flagged", "[rig]") {
  CHECK(response(std::string(kTcrt5000)).read(1.01).flags == (flag::kFolded | flag::kOutOfRange));
}

TEST_CASE("range_m and peak_m go before the model's own", "[rig]") {
  const auto sensor = response(
      "{ model = \"table\", volts = [0.31, 0.42, 0.55], gap_m = [0.026, 0.020, 0.016], "
      "range_m = [0.017, 0.025], peak_m = 0.0165 }");
  CHECK(sensor.nearest_m == 0.017);
  CHECK(sensor.farthest_m == 0.025);
  CHECK(sensor.peak_m == 0.0165);
}

TEST_CASE("An unknown model is told the four", "[rig]") {
  CHECK(response_error("{ model = \"cubic\" }") ==
        "model: found \"cubic\", expected \"linear\", \"table\", \"inverse_square\" or "
        "\"polynomial\"");
  CHECK(response_error("{ model = 3 }") ==
        "model: found 3, expected \"linear\", \"table\", \"inverse_square\" or \"polynomial\"");
  CHECK(response_error("{ }") ==
        "model: missing, expected \"linear\", \"table\", \"inverse_square\" or \"polynomial\"");
}

TEST_CASE("Each number of a model is missed", "[rig]") {
  CHECK(response_error("{ model = \"linear\", slope_m_per_v = 1 }") ==
        "gap_at_zero_m: missing, expected a number");
  CHECK(response_error("{ model = \"linear\", gap_at_zero_m = 1 }") ==
        "slope_m_per_v: missing, expected a number");
  CHECK(response_error("{ model = \"inverse_square\", b_m = 0, c_v = 0 }") ==
        "a_v_m2: missing, expected a number above 0");
  CHECK(response_error("{ model = \"inverse_square\", a_v_m2 = 1, c_v = 0 }") ==
        "b_m: missing, expected a number not below 0");
  CHECK(response_error("{ model = \"inverse_square\", a_v_m2 = 1, b_m = 0 }") ==
        "c_v: missing, expected a number");
  CHECK(response_error("{ model = \"polynomial\", range_v = [0, 1] }") ==
        "coefficients: missing, expected an array of 2 to 8 numbers");
  CHECK(response_error("{ model = \"polynomial\", coefficients = [0, 1] }") ==
        "range_v: missing, expected an array of 2 numbers");
  CHECK(response_error("{ model = \"table\", gap_m = [1, 2] }") ==
        "volts: missing, expected an array of 2 to 32 numbers");
  CHECK(response_error("{ model = \"table\", volts = [1, 2] }") ==
        "gap_m: missing, expected an array of 2 to 32 numbers");
}

TEST_CASE("A linear response needs a slope", "[rig]") {
  CHECK(response_error("{ model = \"linear\", gap_at_zero_m = 0.01, slope_m_per_v = 0 }") ==
        "slope_m_per_v: found 0, expected a slope");
}

TEST_CASE("An inverse square falls with the gap", "[rig]") {
  CHECK(response_error("{ model = \"inverse_square\", a_v_m2 = -1, b_m = 0, c_v = 0 }") ==
        "a_v_m2: found -1, expected a number above 0");
  CHECK(response_error("{ model = \"inverse_square\", a_v_m2 = 1, b_m = -1, c_v = 0 }") ==
        "b_m: found -1, expected a number not below 0");
}

TEST_CASE("A polynomial that turns round in its range is refused", "[rig]") {
  // v^2 - v turns at 0.5 V.
  CHECK(response_error("{ model = \"polynomial\", coefficients = [0, -1, 1], range_v = [0, 1] }") ==
        "range_v: the gap must keep rising or keep falling from the first to the second");
}

TEST_CASE("A polynomial's range runs upwards", "[rig]") {
  CHECK(response_error("{ model = \"polynomial\", coefficients = [0, 1], range_v = [1, 0] }") ==
        "range_v: the gap must keep rising or keep falling from the first to the second");
}

TEST_CASE("A polynomial has two to eight coefficients", "[rig]") {
  const std::string coefficients = GENERATE("[ 1 ]", "[ 1, 2, 3, 4, 5, 6, 7, 8, 9 ]");
  CHECK(response_error(
            "{ model = \"polynomial\", range_v = [0, 1], coefficients = " + coefficients + " }") ==
        "coefficients: found " + coefficients + ", expected an array of 2 to 8 numbers");
}

TEST_CASE("A table has as many gaps as volts", "[rig]") {
  CHECK(response_error("{ model = \"table\", volts = [1, 2, 3], gap_m = [1, 2] }") ==
        "gap_m: found 2 numbers, expected as many as volts has, 3");
}

TEST_CASE("A table of more points than a curve holds is refused", "[rig]") {
  std::string numbers = "0";
  for (int i = 1; i <= 32; ++i) {
    numbers += ", " + std::to_string(i);
  }
  CHECK(response_error("{ model = \"table\", volts = [" + numbers + "], gap_m = [1, 2] }") ==
        "volts: found [ " + numbers + " ], expected an array of 2 to 32 numbers");
}

TEST_CASE("A gap that stands twice in a table is refused", "[rig]") {
  CHECK(response_error("{ model = \"table\", volts = [1, 2, 3], gap_m = [1, 2, 1] }") ==
        "gap_m: the same gap stands there twice");
}

TEST_CASE("A table that turns round twice is refused", "[rig]") {
  CHECK(response_error("{ model = \"table\", volts = [1, 3, 2, 4], gap_m = [1, 2, 3, 4] }") ==
        "volts: the signal turns round more than once, expected at most one peak");
}

TEST_CASE("A table with the same signal at neighbouring gaps is refused", "[rig]") {
  const std::string volts = GENERATE("[1, 1, 2]", "[1, 2, 2]", "[1, 2, 2, 1]");
  const std::string gaps = volts.size() > 10 ? "[1, 2, 3, 4]" : "[1, 2, 3]";
  CHECK(response_error("{ model = \"table\", volts = " + volts + ", gap_m = " + gaps + " }")
            .starts_with("volts: "));
}

TEST_CASE("A range runs from the nearest gap to the farthest", "[rig]") {
  CHECK(response_error("{ model = \"linear\", gap_at_zero_m = 0.01, slope_m_per_v = 1, "
                       "range_m = [0.03, 0.01] }") ==
        "range_m: expected the nearest gap, then the farthest");
}

TEST_CASE("A peak is not behind the sensor", "[rig]") {
  CHECK(response_error("{ model = \"linear\", gap_at_zero_m = 0.01, slope_m_per_v = 1, "
                       "peak_m = -1 }") == "peak_m: found -1, expected a number not below 0");
}

}  // namespace
