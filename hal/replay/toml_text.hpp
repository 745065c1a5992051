// SPDX-License-Identifier: Apache-2.0
// TOML values as text, for headers and messages.
#pragma once

#include <toml++/toml.h>
#include <string>

namespace penduline {

/// A value as it could stand in a file, on one line.
[[nodiscard]] std::string toml_text(const toml::node& node);

}  // namespace penduline
