// SPDX-License-Identifier: Apache-2.0
// Reads a rig file: what the program must know of the apparatus, in TOML.
#pragma once

#include <optional>
#include <string>
#include <tl/expected.hpp>
#include <vector>

#include "common/rig.hpp"
#include "hal/error.hpp"
#include "host/calibration_section.hpp"
#include "host/gpio_section.hpp"

namespace penduline {

/// A rig as its file describes it.
struct RigFile {
  Rig<double> rig;
  std::vector<std::string> sensor_names;
  RigLines lines;
  std::optional<CalibrationRecord> calibration{};  ///< where the numbers come from, if it says so
  std::vector<std::string> complaints;             ///< unknown keys, which are probably misspelt
};

/// Reads a rig file (docs/formats.md). The error names file, line and key, the value found and what
/// was expected.
[[nodiscard]] tl::expected<RigFile, Error> read_rig_file(const std::string& path);

/// The same from text; `name` stands for the file in messages.
[[nodiscard]] tl::expected<RigFile, Error> parse_rig(const std::string& toml_text,
                                                     const std::string& name);

}  // namespace penduline
