// SPDX-License-Identifier: Apache-2.0
// Tests of a rig file's lines: how they are written, and each message in full.
#include "host/gpio_section.hpp"

#include <catch2/catch.hpp>
#include <string>

#include "host/rig_file.hpp"
#include "tests/unit/host/rig_text.hpp"

namespace {

using namespace penduline;
using namespace penduline::test;

/// A rig with the section, whose header is on line 20.
std::string rig_with_gpio(const std::string& keys) {
  return std::string(kRigText) + "[gpio]\n" + keys;
}

RigFile rig_of(const std::string& keys) {
  return parse_rig(rig_with_gpio(keys), "rig.toml").value();
}

std::string error_of(const std::string& keys) {
  return rig_error(rig_with_gpio(keys));
}

TEST_CASE("A rig without the section has no lines", "[gpio]") {
  const RigLines lines = parse_rig(std::string(kRigText), "rig.toml").value().lines;
  for (const GpioKeyDescription& description : kGpioKeys) {
    CHECK_FALSE(lines.*description.line);
  }
}

TEST_CASE("A line is its name, or a table that also says what active means", "[gpio]") {
  const RigFile rig = rig_of(
      "reset = { line = \"GPIO17\", active_low = true }\n"
      "release = \"GPIO27\"\n"
      "status_led = { line = \"GPIO22\" }\n"
      "trigger = { line = \"GPIO23\", active_low = false }\n");
  CHECK(rig.complaints.empty());
  CHECK(rig.lines.reset == GpioLine{.name = "GPIO17", .active_low = true});
  CHECK(rig.lines.release == GpioLine{.name = "GPIO27", .active_low = false});
  CHECK(rig.lines.status_led == GpioLine{.name = "GPIO22", .active_low = false});
  CHECK(rig.lines.trigger == GpioLine{.name = "GPIO23", .active_low = false});
}

TEST_CASE("Each line is optional", "[gpio]") {
  const RigLines lines = rig_of("trigger = \"GPIO23\"\n").lines;
  CHECK(lines.trigger == GpioLine{.name = "GPIO23"});
  CHECK_FALSE(lines.reset);
}

TEST_CASE("What is no line is shown", "[gpio]") {
  CHECK(error_of("reset = 17\n") ==
        "rig.toml:21: [gpio] reset: found 17, expected a line's name in quotes, or { line = "
        "\"NAME\", active_low = true }");
  CHECK(error_of("release = \"\"\n") ==
        "rig.toml:21: [gpio] release: found no name, expected a line's name in quotes, or { line = "
        "\"NAME\", active_low = true }");
  CHECK(error_of("trigger = { active_low = true }\n") ==
        "rig.toml:21: [gpio] trigger line: missing, expected a line's name in quotes");
  CHECK(error_of("trigger = { line = \"A\", active_low = 1 }\n") ==
        "rig.toml:21: [gpio] trigger active_low: found 1, expected true or false");
}

TEST_CASE("A section that is no table is refused", "[gpio]") {
  CHECK(rig_error("gpio = 3\n" + std::string(kRigText)) ==
        "rig.toml:1: rig file gpio: found 3, expected a table");
}

TEST_CASE("Two purposes of one line are refused", "[gpio]") {
  CHECK(error_of("reset = \"A\"\nstatus_led = { line = \"A\" }\n") ==
        "rig.toml:22: [gpio] status_led: found 'A', which is reset already, expected a line of its "
        "own");
}

TEST_CASE("Unknown keys are ignored with a warning", "[gpio]") {
  CHECK(rig_of("led = \"A\"\nreset = { line = \"B\", low = true }\n").complaints ==
        std::vector<std::string>{
            "rig.toml:22: [gpio] reset low: unknown key, ignored; known are active_low, line",
            "rig.toml:21: [gpio] led: unknown key, ignored; known are release, reset, status_led, "
            "trigger"});
}

}  // namespace
