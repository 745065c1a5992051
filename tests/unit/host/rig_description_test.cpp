// SPDX-License-Identifier: Apache-2.0
// Tests of a rig's description in JSON.
#include "host/output/rig_description.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/unit/host/rig_text.hpp"

namespace {

using namespace penduline;
using namespace penduline::test;

using Json = nlohmann::json;

Json described(const RigFile& rig) {
  const RecordingHeader header{
      .acquisition = {.rate_hz = 50}, .board = "pico", .firmware = "0.1.0", .started = ""};
  return Json::parse(describe_rig(rig, header, "gn"));
}

Json described(const std::string& rig_text) {
  return described(parse_rig(rig_text, "rig.toml").value());
}

TEST_CASE("A rig is described by its file's numbers and what stands around it", "[output]") {
  Json description = described(std::string(kRigText));
  CHECK_FALSE(description["machine"].get<std::string>().empty());
  description.erase("machine");
  CHECK(description == Json::parse(R"({
    "penduline": "0.1.0", "board": "pico", "firmware": "0.1.0", "rate_hz": 50,
    "estimator": "gn",
    "pendulum": {"length_m": 0.3, "mass_kg": 0.1, "gravity_m_s2": 9.8, "damping_per_s": 0.01},
    "disc": {"offset_m": 0.02, "diameter_m": 0.12},
    "sensors": [{"name": "Sx", "position_m": [0.02, 0, 0]},
                {"name": "Sy", "position_m": [0, 0.02, 0]}]})"));
}

TEST_CASE("A board's name that is no UTF-8 does not spoil the description", "[output]") {
  const RecordingHeader header{
      .acquisition = {}, .board = "p\xffico", .firmware = "", .started = ""};
  const auto rig = parse_rig(std::string(kRigText), "rig.toml").value();
  CHECK(Json::accept(describe_rig(rig, header, "gn")));
}

}  // namespace
