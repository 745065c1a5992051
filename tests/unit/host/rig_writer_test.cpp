// SPDX-License-Identifier: Apache-2.0
#include "host/rig_writer.hpp"

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "host/rig_file.hpp"
#include "tests/unit/host/rig_text.hpp"
#include "tests/unit/temporary_folder.hpp"

using namespace penduline;
using namespace penduline::test;

namespace {

CalibrationRecord record() {
  return {.method = "static",
          .date = "2026-11-21T07:00:00Z",
          .recordings = {"a.csv", "it's \"b\".csv"},
          .residual_m = 1.2e-5,
          .parameters = {"Sx a", "Sx b"},
          .values = Eigen::Vector2d(0.5, -2),
          .covariance = (Eigen::Matrix2d() << 4e-6, 1e-6, 1e-6, 9e-6).finished(),
          .not_determined = {}};
}

/// The rig's text after the changes, from a file of this text.
std::string rewritten(const std::string& text, const RigChanges& changes) {
  const TemporaryFolder folder;
  std::ofstream(folder.path("rig.toml")) << text;
  return rewritten_rig(folder.path("rig.toml"), changes, record()).value();
}

RigChanges with_response(const Response<double>& response) {
  RigChanges changes;
  changes.responses[0] = response;
  return changes;
}

}  // namespace

TEST_CASE("A rewritten rig keeps what was not changed, also what the program does not know",
          "[rig_writer]") {
  const std::string before = std::string(kRigText) +
                             "[gpio]\nreset = { line = \"GPIO5\", active_low = true }\n"
                             "[laboratory]\nroom = \"3.14\"\n";
  const std::string text = rewritten(before, {});
  const RigFile rig = parse_rig(text, "new").value();
  CHECK(rig.rig.pendulum.length_m == 0.3);
  CHECK(rig.rig.pendulum.damping_per_s == 0.01);
  CHECK(rig.sensor_names == std::vector<std::string>{"Sx", "Sy"});
  REQUIRE(rig.rig.filter);
  CHECK(rig.rig.filter->order == 15);
  REQUIRE(rig.lines.reset);
  CHECK(rig.lines.reset->name == "GPIO5");
  CHECK(rig.lines.reset->active_low);
  CHECK(text.find("[laboratory]\nroom = \"3.14\"\n") != std::string::npos);
}

TEST_CASE("A signal's noise is written with two digits", "[rig_writer]") {
  RigChanges changes;
  changes.noise_v[1] = 0.00051234;
  const RigFile rig = parse_rig(rewritten(std::string(kRigText), changes), "new").value();
  CHECK(rig.rig.noise[0].volts == 0.0005);
  CHECK(rig.rig.noise[1].volts == 0.00051);
}

TEST_CASE("Numbers are written as a person would", "[rig_writer]") {
  RigChanges changes;
  changes.positions_m[1] = Vector3<double>(0, 0.0200123456, -0.011);
  const std::string text = rewritten(std::string(kRigText), changes);
  CHECK(text.find("length_m = 0.3\n") != std::string::npos);
  CHECK(text.find("position_m = [0.0, 0.0200123, -0.011]\n") != std::string::npos);
}

TEST_CASE("Every model of a response comes back from a rewritten rig", "[rig_writer]") {
  const auto came_back = [](const Response<double>& response) {
    const std::string text = rewritten(std::string(kRigText), with_response(response));
    return parse_rig(text, "new").value().rig.responses[0];
  };
  const std::array volts = {0.2, 0.5, 1.2};
  const std::array gaps = {0.015, 0.009, 0.004};
  const std::array<Response<double>, 4> responses = {
      Response<double>{
          .model = LinearResponse<double>{0.03, -0.006}, .nearest_m = 0.004, .farthest_m = 0.015},
      Response<double>{.model = TableResponse<double>{MonotoneCubic<double>(volts, gaps)},
                       .nearest_m = 0.004,
                       .farthest_m = 0.015,
                       .peak_m = 0.0024},
      Response<double>{.model = InverseSquareResponse<double>{1e-4, 0.004, 0.02},
                       .nearest_m = 0.004,
                       .farthest_m = 0.015,
                       .peak_m = 0.0024},
      Response<double>{.model = PolynomialResponse<double>{{0.02, -0.01, 0.001}, 3, 0.2, 1.2},
                       .nearest_m = 0.00944,
                       .farthest_m = 0.01804}};
  for (const Response<double>& response : responses) {
    const Response<double> back = came_back(response);
    CHECK(back.model.index() == response.model.index());
    CHECK(back.read(0.7).gap_m.value() == Approx(response.read(0.7).gap_m.value()).epsilon(1e-9));
    CHECK(back.nearest_m == Approx(response.nearest_m));
    CHECK(back.farthest_m == Approx(response.farthest_m));
    CHECK(back.peak_m == response.peak_m);
  }
}

TEST_CASE("The record of a calibration comes back, and a second replaces it", "[rig_writer]") {
  const std::string once = rewritten(std::string(kRigText), {});
  const auto rig = parse_rig(rewritten(once, {}), "new");
  REQUIRE(rig);
  REQUIRE(rig->calibration);
  CHECK(rig->complaints.empty());
  CHECK(rig->calibration->method == "static");
  CHECK(rig->calibration->date == "2026-11-21T07:00:00Z");
  CHECK(rig->calibration->recordings == record().recordings);
  CHECK(rig->calibration->residual_m == 1.2e-5);
  CHECK(rig->calibration->parameters == record().parameters);
  CHECK(rig->calibration->values == record().values);
  CHECK(rig->calibration->covariance.isApprox(record().covariance));
}

TEST_CASE("A rig that cannot be read is not rewritten", "[rig_writer]") {
  const auto text = rewritten_rig("missing.toml", {}, record());
  REQUIRE_FALSE(text);
  CHECK(text.error().message.starts_with("missing.toml: "));
}
