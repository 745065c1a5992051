// SPDX-License-Identifier: Apache-2.0
// The check of an option's number.
#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "hal/replay/cells.hpp"

namespace penduline {

/// Accepts numbers from `least` to `most`. CLI11's own Range lets `nan` through.
[[nodiscard]] inline CLI::Validator number_within(double least, double most) {
  return CLI::Validator(
      [least, most](const std::string& text) {
        const auto number = parse_number<double>(text);
        const bool good = number && *number >= least && *number <= most;
        return good ? std::string()
                    : fmt::format("found {}, expected a number from {} to {}", text, least, most);
      },
      "");
}

}  // namespace penduline
