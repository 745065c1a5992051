// SPDX-License-Identifier: Apache-2.0
// Reads a sensor's response from a rig file and checks that it has an inverse.
#pragma once

#include <string>

#include "common/response.hpp"
#include "host/toml_section.hpp"

namespace penduline {

/// The response that a table `{ model = ..., ... }` describes; what is wrong with it goes into
/// `findings`, and the value then does not count.
[[nodiscard]] Response<double> read_response(const toml::table& table, const std::string& path,
                                             TomlFindings& findings);

}  // namespace penduline
