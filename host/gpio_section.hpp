// SPDX-License-Identifier: Apache-2.0
// The section [gpio] of a rig file: what is wired to the lines of a single-board computer.
#pragma once

#include <toml++/toml.h>
#include <array>
#include <optional>
#include <string_view>

#include "hal/linux/gpio.hpp"
#include "host/toml_section.hpp"

namespace penduline {

/// The lines of a rig, each where it has one.
struct RigLines {
  std::optional<GpioLine> reset;
  std::optional<GpioLine> release;
  std::optional<GpioLine> status_led;
  std::optional<GpioLine> trigger;
};

struct GpioKeyDescription {
  std::string_view key;
  std::optional<GpioLine> RigLines::*line;
  std::string_view meaning;
};

/// Every key of the section.
inline constexpr std::array kGpioKeys = {
    GpioKeyDescription{"reset", &RigLines::reset, "output, active: the board is held in reset"},
    GpioKeyDescription{"release", &RigLines::release, "output, active: the magnet holds"},
    GpioKeyDescription{"status_led", &RigLines::status_led, "output, active: samples come"},
    GpioKeyDescription{"trigger", &RigLines::trigger,
                       "input; its edges into the active state are recorded"},
};

/// Reads the section. Each line has a name of its own.
[[nodiscard]] RigLines read_gpio(const toml::table& table, TomlFindings& findings);

}  // namespace penduline
