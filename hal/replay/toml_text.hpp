// SPDX-License-Identifier: Apache-2.0
// TOML values as text, for headers, events and messages.
#pragma once

#include <toml++/toml.h>
#include <string>

namespace penduline {

/// A value as it could stand in a file, on one line.
[[nodiscard]] std::string toml_text(const toml::node& node);

/// Any text as a TOML string, always on one line; bytes that are not UTF-8 are replaced.
[[nodiscard]] std::string toml_quoted(const std::string& text);

}  // namespace penduline
