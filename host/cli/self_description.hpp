// SPDX-License-Identifier: Apache-2.0
// What the program tells shells and the build of itself; no command of a user's.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <span>
#include <string>

namespace penduline {

/// The answer to the arguments `complete WORD...` and `manual`; none where they are others.
[[nodiscard]] std::optional<std::string> describe_itself(const CLI::App& program,
                                                         std::span<const char* const> arguments);

}  // namespace penduline
