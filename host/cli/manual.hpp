// SPDX-License-Identifier: Apache-2.0
// The manual's page on the commands, by their definition.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace penduline {

/// A subsection for each command, in the language mdoc(7).
[[nodiscard]] std::string manual_of_commands(const CLI::App& program);

}  // namespace penduline
