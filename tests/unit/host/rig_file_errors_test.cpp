// SPDX-License-Identifier: Apache-2.0
// Tests of wrong rig files: each message in full, with file, line, key, what is found and expected.
#include <catch2/catch.hpp>
#include <string>

#include "host/rig_file.hpp"
#include "tests/unit/host/rig_text.hpp"
#include "tests/unit/temporary_folder.hpp"

namespace {

using namespace penduline;
using namespace penduline::test;

TEST_CASE("A file that is not TOML is told the line and why", "[rig]") {
  // The reason is toml++ 3.3's.
  CHECK(rig_error(rig_with(3, "mass_kg 0.1")) ==
        "rig.toml:3: not TOML: Error while parsing key-value pair: expected '=', saw '0'");
}

TEST_CASE("A rig file's own characters do not break a message's line", "[rig]") {
  // toml++ quotes the line's end.
  CHECK(rig_error(rig_with(3, "mass_kg = f")) ==
        "rig.toml:3: not TOML: Error while parsing boolean: expected 'false', saw 'f?'");
}

TEST_CASE("A missing section is named", "[rig]") {
  CHECK(rig_error("") == "rig.toml:1: rig file pendulum: missing, expected [pendulum]");
  CHECK(rig_error("[pendulum]\nlength_m = 1\n") ==
        "rig.toml:1: rig file disc: missing, expected [disc]");
  CHECK(rig_error("[pendulum]\nlength_m = 1\n[disc]\noffset_m = 1\ndiameter_m = 1\n") ==
        "rig.toml:1: rig file sensor: missing, expected [[sensor]]");
}

TEST_CASE("A section that is no table is shown", "[rig]") {
  CHECK(rig_error("pendulum = 3\n") == "rig.toml:1: rig file pendulum: found 3, expected a table");
}

TEST_CASE("A single sensor table is refused in one line", "[rig]") {
  const std::string error = rig_error(
      "[pendulum]\nlength_m = 1\n[disc]\noffset_m = 1\ndiameter_m = 1\n"
      "[sensor]\nname = \"Sx\"\nposition_m = [1, 0, 0]\n");
  CHECK(error.starts_with("rig.toml:6: rig file sensor: found "));
  CHECK(error.ends_with(", expected tables [[sensor]]"));
  CHECK(error.find('\n') == std::string::npos);
}

TEST_CASE("Each required number is missed", "[rig]") {
  CHECK(rig_error(rig_with(2, "")) ==
        "rig.toml:1: [pendulum] length_m: missing, expected a number above 0");
  CHECK(rig_error(rig_with(7, "")) ==
        "rig.toml:6: [disc] offset_m: missing, expected a number above 0");
  CHECK(rig_error(rig_with(8, "")) ==
        "rig.toml:6: [disc] diameter_m: missing, expected a number above 0");
  CHECK(rig_error(rig_with(18, "")) ==
        "rig.toml:17: [filter] order: missing, expected a whole number from 0 to 63");
  CHECK(rig_error(rig_with(19, "")) ==
        "rig.toml:17: [filter] cutoff_of_nyquist: missing, expected a number above 0, up to 1");
}

TEST_CASE("Numbers that must be above 0 are not 0", "[rig]") {
  CHECK(rig_error(rig_with(2, "length_m = 0")) ==
        "rig.toml:2: [pendulum] length_m: found 0, expected a number above 0");
  CHECK(rig_error(rig_with(3, "mass_kg = 0")) ==
        "rig.toml:3: [pendulum] mass_kg: found 0, expected a number above 0");
  CHECK(rig_error(rig_with(4, "gravity_m_s2 = -9.5")) ==
        "rig.toml:4: [pendulum] gravity_m_s2: found -9.5, expected a number above 0");
  CHECK(rig_error(rig_with(7, "offset_m = 0")) ==
        "rig.toml:7: [disc] offset_m: found 0, expected a number above 0");
  CHECK(rig_error(rig_with(8, "diameter_m = -1")) ==
        "rig.toml:8: [disc] diameter_m: found -1, expected a number above 0");
}

TEST_CASE("Damping is not negative", "[rig]") {
  CHECK(rig_error(rig_with(5, "damping_per_s = -1")) ==
        "rig.toml:5: [pendulum] damping_per_s: found -1, expected a number not below 0");
}

TEST_CASE("A number is shown as the file has it", "[rig]") {
  // Not as -0.29999999999999999.
  CHECK(rig_error(rig_with(2, "length_m = -0.3")) ==
        "rig.toml:2: [pendulum] length_m: found -0.3, expected a number above 0");
  CHECK(rig_error(rig_with(19, "cutoff_of_nyquist = 1.0000001")) ==
        "rig.toml:19: [filter] cutoff_of_nyquist: found 1.0000001, expected a number above 0, up "
        "to 1");
}

TEST_CASE("NaN and infinity are no numbers of a rig", "[rig]") {
  CHECK(rig_error(rig_with(2, "length_m = nan")) ==
        "rig.toml:2: [pendulum] length_m: found nan, expected a number above 0");
  CHECK(rig_error(rig_with(2, "length_m = inf")) ==
        "rig.toml:2: [pendulum] length_m: found inf, expected a number above 0");
}

TEST_CASE("What is no number is shown", "[rig]") {
  CHECK(rig_error(rig_with(2, "length_m = \"long\"")) ==
        "rig.toml:2: [pendulum] length_m: found 'long', expected a number above 0");
  CHECK(rig_error(rig_with(3, "mass_kg = true")) ==
        "rig.toml:3: [pendulum] mass_kg: found true, expected a number above 0");
  CHECK(rig_error(rig_with(4, "gravity_m_s2 = [9.5]")) ==
        "rig.toml:4: [pendulum] gravity_m_s2: found [ 9.5 ], expected a number above 0");
}

TEST_CASE("A filter's order is a whole number of taps that there are", "[rig]") {
  const std::string order = GENERATE("15.5", "64", "-1");
  CHECK(rig_error(rig_with(18, "order = " + order)) ==
        "rig.toml:18: [filter] order: found " + order + ", expected a whole number from 0 to 63");
}

TEST_CASE("A filter's cutoff is above 0 and at most Nyquist", "[rig]") {
  const std::string cutoff = GENERATE("0", "1.5", "-0.5");
  CHECK(rig_error(rig_with(19, "cutoff_of_nyquist = " + cutoff)) ==
        "rig.toml:19: [filter] cutoff_of_nyquist: found " + cutoff +
            ", expected a number above 0, up to 1");
}

TEST_CASE("A sensor's name is a text", "[rig]") {
  CHECK(rig_error(rig_with(10, "name = 5")) ==
        "rig.toml:10: [[sensor]] 1 name: found 5, expected a name in quotes");
}

TEST_CASE("A sensor's position is three numbers", "[rig]") {
  CHECK(rig_error(rig_with(15, "")) ==
        "rig.toml:13: [[sensor]] 2 position_m: missing, expected an array of 3 numbers");
  CHECK(rig_error(rig_with(15, "position_m = 0.02")) ==
        "rig.toml:15: [[sensor]] 2 position_m: found 0.02, expected an array of 3 numbers");
  CHECK(rig_error(rig_with(15, "position_m = [0, 2]")) ==
        "rig.toml:15: [[sensor]] 2 position_m: found [ 0, 2 ], expected an array of 3 numbers");
  CHECK(rig_error(rig_with(15, "position_m = [0, 2, \"up\"]")) ==
        "rig.toml:15: [[sensor]] 2 position_m: found [ 0, 2, 'up' ], expected an array of 3 "
        "numbers");
  CHECK(rig_error(rig_with(15, "position_m = [0, 2, inf]")) ==
        "rig.toml:15: [[sensor]] 2 position_m: found [ 0, 2, inf ], expected an array of 3 "
        "numbers");
}

TEST_CASE("A sensor needs a response", "[rig]") {
  CHECK(rig_error(rig_with(12, "")) ==
        "rig.toml:9: [[sensor]] 1 response: missing, expected a table such as { model = "
        "\"linear\", ... }");
  CHECK(rig_error(rig_with(12, "response = \"linear\"")) ==
        "rig.toml:12: [[sensor]] 1 response: found 'linear', expected a table");
}

/// A rig of some sensors all at their places, each with a response.
std::string rig_with_places(int count, const std::string& place) {
  std::string text = "[pendulum]\nlength_m = 0.3\n[disc]\noffset_m = 0.02\ndiameter_m = 0.12\n";
  for (int i = 0; i < count; ++i) {
    text += "[[sensor]]\nposition_m = " + place +
            "\nresponse = { model = \"linear\", gap_at_zero_m = 0.01, slope_m_per_v = 0.006 }\n";
  }
  return text;
}

TEST_CASE("One sensor is too few, nine are too many", "[rig]") {
  CHECK(rig_error(rig_with_places(1, "[0.02, 0, 0]")) ==
        "rig.toml:6: [[sensor]]: found 1, expected 2 to 8");
  CHECK(rig_error(rig_with_places(9, "[0.02, 0, 0]")) ==
        "rig.toml:6: [[sensor]]: found 9, expected 2 to 8");
}

TEST_CASE("Sensors on one line through the pivot are refused", "[rig]") {
  const std::string place = GENERATE("[0.02, 0, 0]", "[0.01, -0.02, 0]", "[0, 0, 0.01]");
  CHECK(rig_error(rig_with_places(3, place)) ==
        "rig.toml:6: [[sensor]]: the positions lie on one line through the pivot, expected sensors "
        "on two sides such as X and Y");
}

TEST_CASE("The first of several errors is told", "[rig]") {
  CHECK(rig_error("[pendulum]\nlength_m = 0\nmass_kg = 0\n[disc]\n") ==
        "rig.toml:2: [pendulum] length_m: found 0, expected a number above 0");
}

TEST_CASE("A rig file that is not there is named", "[rig]") {
  const TemporaryFolder folder;
  const auto file = read_rig_file(folder.path("none.toml"));
  REQUIRE_FALSE(file);
  CHECK(folder.relative(file.error().message) == "none.toml: No such file or directory");
}

TEST_CASE("A folder is no rig file", "[rig]") {
  const TemporaryFolder folder;
  const auto file = read_rig_file(folder.path());
  REQUIRE_FALSE(file);
  CHECK(file.error().message == folder.path() + ": Is a directory");
}

}  // namespace
