// SPDX-License-Identifier: Apache-2.0
// The options of `run` about the lines of a single-board computer.
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>
#include <string>
#include <tl/expected.hpp>

#include "host/gpio/session_lines.hpp"
#include "host/rig_file.hpp"

namespace penduline {

struct LineOptions {
  bool reset = false;
  std::optional<double> release_s{};
};

void add_line_options(CLI::App& command, LineOptions& options);

/// Throws CLI::ValidationError, saying `why`, where one of the options was given.
void refuse_line_options(const LineOptions& options, const std::string& why);

/// Throws CLI::ValidationError where an option asks for a line that the rig does not have.
void require_lines(const LineOptions& options, const RigLines& rig, const std::string& rig_path);

/// Opens the rig's lines, that of the trigger for a recording only, and resets the board where it
/// is asked for.
[[nodiscard]] tl::expected<std::unique_ptr<SessionLines>, Error> open_lines(
    const LineOptions& options, const RigLines& rig, bool recording);

}  // namespace penduline
