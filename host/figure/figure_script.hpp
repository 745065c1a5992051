// SPDX-License-Identifier: Apache-2.0
// A figure in gnuplot's language.
#pragma once

#include <optional>
#include <string>

#include "host/figure/figure.hpp"

namespace penduline {

/// Gnuplot's terminal for a file's ending; none where there is none for it.
[[nodiscard]] std::optional<std::string> terminal_for(const Figure& figure,
                                                      const std::string& path);

/// The script that draws a figure with `terminal` to the standard output.
[[nodiscard]] std::string script_of(const Figure& figure, const std::string& terminal);

}  // namespace penduline
