// SPDX-License-Identifier: Apache-2.0
// Tests of reading good rig files: every key, the defaults, unknown keys.
#include "host/rig_file.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "tests/unit/host/rig_text.hpp"
#include "tests/unit/temporary_folder.hpp"

namespace {

using namespace penduline;
using namespace penduline::test;

using Lines = std::vector<std::string>;

RigFile good(const std::string& text) {
  auto rig = parse_rig(text, "rig.toml");
  if (!rig) {
    throw std::runtime_error(rig.error().message);
  }
  return *rig;
}

TEST_CASE("design.md's rig reads as it says", "[rig]") {
  const RigFile file = good(
      "[pendulum]\n"
      "length_m = 0.3\n"
      "mass_kg = 0.1\n"
      "gravity_m_s2 = 9.8\n"
      "damping_per_s = 0.01\n"
      "[disc]\n"
      "offset_m = 0.02            # pivot to disc along the rod: the paper's lp\n"
      "diameter_m = 0.12\n"
      "[[sensor]]\n"
      "name = \"Sx\"\n"
      "position_m = [0.02, 0.0, 0.0]      # of the sensor's face; it looks down -Z\n"
      "response = { model = \"table\", volts = [0.31, 0.42, 0.55], gap_m = [0.026, 0.020, 0.016] "
      "}\n"
      "[[sensor]]\n"
      "name = \"Sy\"\n"
      "position_m = [0.0, 0.02, 0.0]\n"
      "response = { model = \"linear\", gap_at_zero_m = 0.031, slope_m_per_v = -0.006 }\n"
      "\n"
      "[filter]                   # optional; of `gn` and `paper`\n"
      "order = 15\n"
      "cutoff_of_nyquist = 0.15\n");
  CHECK(file.complaints.empty());
  CHECK(file.rig.pendulum.length_m == 0.3);
  CHECK(file.rig.pendulum.mass_kg == 0.1);
  CHECK(file.rig.pendulum.gravity_m_s2 == 9.8);
  CHECK(file.rig.pendulum.damping_per_s == 0.01);
  CHECK(file.rig.layout.disc_offset_m == 0.02);
  CHECK(file.rig.disc_diameter_m == 0.12);
  CHECK(file.rig.layout.count == 2);
  CHECK(file.sensor_names == Lines{"Sx", "Sy"});
  CHECK(file.rig.layout.position_m[0] == Vector3<double>(0.02, 0, 0));
  CHECK(file.rig.layout.position_m[1] == Vector3<double>(0, 0.02, 0));
  CHECK(file.rig.responses[0].read(0.42).gap_m == 0.020);
  CHECK(file.rig.responses[1].read(2).gap_m == 0.031 - 0.006 * 2);
  CHECK(file.rig.filter->order == 15);
  CHECK(file.rig.filter->cutoff_of_nyquist == 0.15);
}

TEST_CASE("What is optional has its default", "[rig]") {
  const RigFile file = good(
      "[pendulum]\nlength_m = 0.5\n[disc]\noffset_m = 0.02\ndiameter_m = 0.12\n"
      "[[sensor]]\nposition_m = [0.02, 0, 0]\n"
      "response = { model = \"linear\", gap_at_zero_m = 0.01, slope_m_per_v = 0.006 }\n"
      "[[sensor]]\nposition_m = [0, 0.02, 0]\n"
      "response = { model = \"linear\", gap_at_zero_m = 0.01, slope_m_per_v = 0.006 }\n");
  CHECK(file.complaints.empty());
  CHECK(file.rig.pendulum.mass_kg == 0.1);
  CHECK(file.rig.pendulum.gravity_m_s2 == 9.8);
  CHECK(file.rig.pendulum.damping_per_s == 0);
  CHECK(file.sensor_names == Lines{"S1", "S2"});
  CHECK_FALSE(file.rig.filter.has_value());
}

TEST_CASE("What the Kalman filter is to believe is read", "[rig]") {
  const RigFile file = good(rig_with(10, "name = \"Sx\"\nnoise_v = 0.002\nnoise_m = 20e-6") +
                            "[ekf]\n"
                            "length_sigma_m = 0.003\n"
                            "damping_sigma_per_s = 0.02\n"
                            "offset_sigma_m = 50e-6\n"
                            "acceleration_rad_s15 = 0.01\n"
                            "damping_walk_per_s15 = 0.001\n"
                            "offset_walk_m_s05 = 1e-6\n");
  CHECK(file.complaints.empty());
  CHECK(file.rig.noise[0].volts == 0.002);
  CHECK(file.rig.noise[0].gap_m == 20e-6);
  CHECK(file.rig.noise[1].volts == 0.0005);
  CHECK(file.rig.noise[1].gap_m == 10e-6);
  CHECK(file.rig.trust.length_share == Approx(0.01));
  CHECK(file.rig.trust.damping_per_s == 0.02);
  CHECK(file.rig.trust.offset_m == 50e-6);
  CHECK(file.rig.trust.acceleration_rad_s15 == 0.01);
  CHECK(file.rig.trust.damping_walk_per_s15 == 0.001);
  CHECK(file.rig.trust.offset_walk_m_s05 == 1e-6);
}

TEST_CASE("A Kalman filter that believes all or nothing is refused", "[rig]") {
  CHECK(rig_error(fmt::format("{}[ekf]\nacceleration_rad_s15 = 0\n", kRigText)) ==
        "rig.toml:21: [ekf] acceleration_rad_s15: found 0, expected a number above 0");
  CHECK(rig_error(rig_with(10, "noise_m = 0")) ==
        "rig.toml:10: [[sensor]] 1 noise_m: found 0, expected a number above 0");
}

TEST_CASE("Numbers may be written without a decimal point", "[rig]") {
  CHECK(good(rig_with(2, "length_m = 2")).rig.pendulum.length_m == 2);
  CHECK(good(rig_with(11, "position_m = [1, 0, 0]")).rig.layout.position_m[0].x() == 1);
}

TEST_CASE("The order of a filter may be written as 15.0", "[rig]") {
  CHECK(good(rig_with(18, "order = 15.0")).rig.filter->order == 15);
}

TEST_CASE("A filter may be switched off and be as long as there are taps", "[rig]") {
  CHECK(good(rig_with(18, "order = 0")).rig.filter->order == 0);
  CHECK(good(rig_with(18, "order = 63")).rig.filter->order == 63);
  CHECK(good(rig_with(19, "cutoff_of_nyquist = 1")).rig.filter->cutoff_of_nyquist == 1);
}

TEST_CASE("Eight sensors are read in their order", "[rig]") {
  std::string text = "[pendulum]\nlength_m = 0.3\n[disc]\noffset_m = 0.02\ndiameter_m = 0.12\n";
  for (int i = 1; i <= 8; ++i) {
    text += fmt::format(
        "[[sensor]]\nposition_m = [0.00{}, {}, 0.001]\n"
        "response = {{ model = \"linear\", gap_at_zero_m = 0.01, slope_m_per_v = 0.00{} }}\n",
        i, i % 2 == 0 ? "0.02" : "-0.02", i);
  }
  const RigFile file = good(text);
  REQUIRE(file.rig.layout.count == 8);
  CHECK(file.sensor_names.back() == "S8");
  CHECK(file.rig.layout.position_m[7] == Vector3<double>(0.008, 0.02, 0.001));
  CHECK(std::get<LinearResponse<double>>(file.rig.responses[7].model).slope_m_per_v == 0.008);
}

TEST_CASE("An unknown key is complained of and the rest is read", "[rig]") {
  const RigFile file = good(rig_with(5, "damping = 0.02"));
  CHECK(file.complaints == Lines{"rig.toml:5: [pendulum] damping: unknown key, ignored; known are "
                                 "damping_per_s, gravity_m_s2, length_m, mass_kg"});
  CHECK(file.rig.pendulum.damping_per_s == 0);
  CHECK(file.rig.layout.count == 2);
}

TEST_CASE("Unknown keys are complained of in every section", "[rig]") {
  CHECK(
      good(fmt::format("colour = 1\n{}", kRigText)).complaints ==
      Lines{"rig.toml:1: rig file colour: unknown key, ignored; known are calibration, disc, ekf, "
            "filter, gpio, pendulum, sensor"});
  CHECK(good(rig_with(6, "[disc]\ncolour = 1")).complaints ==
        Lines{"rig.toml:7: [disc] colour: unknown key, ignored; known are diameter_m, offset_m"});
  CHECK(good(rig_with(14, "colour = 1")).complaints ==
        Lines{"rig.toml:14: [[sensor]] 2 colour: unknown key, ignored; known are name, "
              "noise_m, noise_v, position_m, response"});
  CHECK(good(rig_with(17, "[filter]\ncolour = 1")).complaints ==
        Lines{"rig.toml:18: [filter] colour: unknown key, ignored; known are cutoff_of_nyquist, "
              "order"});
}

TEST_CASE("A response's unknown key is told all that its model knows", "[rig]") {
  CHECK(good(rig_with_response("{ model = \"linear\", gap_at_zero_m = 0.031, "
                               "slope_m_per_v = -0.006, rangem = [0.01, 0.03] }"))
            .complaints ==
        Lines{"rig.toml:12: [[sensor]] 1 response rangem: unknown key, ignored; known are "
              "gap_at_zero_m, model, peak_m, range_m, slope_m_per_v"});
}

TEST_CASE("A key's control characters do not reach the terminal", "[rig]") {
  CHECK(good(rig_with(6, "[disc]\n\"a\\n\\u001b[31m\" = 1")).complaints ==
        Lines{"rig.toml:7: [disc] a??[31m: unknown key, ignored; known are diameter_m, offset_m"});
}

TEST_CASE("Several unknown keys are each complained of", "[rig]") {
  CHECK(good(rig_with(1, "a = 1\nb = 2\n[pendulum]")).complaints.size() == 2);
}

TEST_CASE("A rig file is read from disk under its name", "[rig]") {
  const TemporaryFolder folder;
  const auto file = read_rig_file(folder.write("rig.toml", rig_with(5, "damping = 0.02")));
  REQUIRE(file);
  REQUIRE(file->complaints.size() == 1);
  CHECK(folder.relative(file->complaints[0]).starts_with("rig.toml:5: [pendulum] damping: "));
}

TEST_CASE("A rig file may come from Windows", "[rig]") {
  std::string text = fmt::format("\xef\xbb\xbf{}", kRigText);
  for (std::size_t at = text.find('\n'); at != std::string::npos; at = text.find('\n', at + 2)) {
    text.insert(at, 1, '\r');
  }
  CHECK(good(text).complaints.empty());
}

TEST_CASE("Every rig in docs/rigs is read without a complaint", "[rig]") {
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(PENDULINE_SOURCE_DIR "/docs/rigs")) {
    CAPTURE(entry.path().string());
    const auto file = read_rig_file(entry.path().string());
    REQUIRE(file);
    CHECK(file->complaints.empty());
    ++count;
  }
  CHECK(count > 0);
}

}  // namespace
