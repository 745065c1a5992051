// SPDX-License-Identifier: Apache-2.0
// Tests of a rig's way to a board when a run begins: once, whole, and refused in words.
#include "host/source/rig_upload.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdint>
#include <string>
#include <vector>

#include "tests/unit/host/scripted_board.hpp"

namespace {

using namespace penduline;
using namespace penduline::test;

const std::string kHello = frame_of(hello_of_boot(1));

/// Settings that store 100 bytes as a rig of two sensors: three pieces.
BoardSettings storing(wire::OnboardEstimator estimator, std::size_t sensor_count = 2) {
  return {.once = true,
          .rig = RigForBoard{.image = std::vector<std::uint8_t>(100, 7),
                             .sensor_count = sensor_count,
                             .estimator = estimator}};
}

std::vector<std::uint8_t> rig_commands_of(const Heard& heard) {
  std::vector<std::uint8_t> commands;
  std::ranges::copy_if(heard.commands, std::back_inserter(commands), [](std::uint8_t type) {
    return type >= wire::BeginRig::kType && type <= wire::EndRig::kType;
  });
  return commands;
}

TEST_CASE("The rig goes to the board before the first sample, and it is said", "[board][rig]") {
  const Heard heard =
      listen({{.pieces = {kHello, sample_frame(0)}}}, storing(wire::OnboardEstimator::kKalman));
  CHECK(rig_commands_of(heard) ==
        std::vector<std::uint8_t>{wire::BeginRig::kType, wire::RigPart::kType, wire::RigPart::kType,
                                  wire::RigPart::kType, wire::EndRig::kType});
  REQUIRE_FALSE(heard.said.empty());
  CHECK(heard.said[0] == "script: the board has stored the rig; it finds angles itself by ekf");
  CHECK(heard.samples.size() == 1);
}

TEST_CASE("A board that comes back has the rig already", "[board][rig]") {
  BoardSettings settings = storing(wire::OnboardEstimator::kGaussNewton);
  settings.once = false;
  const Heard heard = listen({{.pieces = {kHello, sample_frame(0)}},
                              {.pieces = {frame_of(hello_of_boot(2)), sample_frame(0)}}},
                             settings);
  CHECK(heard.samples.size() == 2);
  CHECK(rig_commands_of(heard).size() == 5);
}

TEST_CASE("A rate at which the board has no time for ekf is told", "[board][rig]") {
  BoardSettings settings = storing(wire::OnboardEstimator::kKalman);
  settings.rate_millihz = 200'000;
  const Heard heard = listen({{.pieces = {kHello, sample_frame(0)}}}, settings);
  REQUIRE(heard.said.size() >= 2);
  CHECK(heard.said[1] ==
        "script: at 200 Hz the board has no time for ekf, above 100 Hz it finds no angles");
  settings.rate_millihz = 100'000;
  CHECK(listen({{.pieces = {kHello, sample_frame(0)}}}, settings).said.size() < 2);
}

TEST_CASE("A rig that the board refuses ends the run with its reason", "[board][rig]") {
  for (const std::uint8_t refused :
       {wire::BeginRig::kType, wire::RigPart::kType, wire::EndRig::kType}) {
    const Heard heard = listen({{.pieces = {kHello}, .refused_command = refused}},
                               storing(wire::OnboardEstimator::kKalman));
    CHECK(heard.error == "script: the board refuses the rig: invalid_rig");
    CHECK(rig_commands_of(heard).back() == refused);
  }
}

TEST_CASE("A rig of other sensors than the board's is not sent", "[board][rig]") {
  const Heard heard =
      listen({{.pieces = {kHello}}}, storing(wire::OnboardEstimator::kGaussNewton, 3));
  CHECK(heard.error ==
        "script: found a rig of 3 sensors to upload, expected 2, as many as the board reads");
  CHECK(rig_commands_of(heard).empty());
}

}  // namespace
