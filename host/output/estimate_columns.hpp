// SPDX-License-Identifier: Apache-2.0
// The columns of an estimate: one list for CSV, JSON lines, tests and docs/formats.md.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

#include "common/estimate.hpp"

namespace penduline {

struct EstimateColumn {
  std::string_view name;
  std::string_view meaning;
  std::size_t decimals;
  /// The column's value; none where the estimate does not have it.
  std::optional<double> (*value)(const Estimate<double>& estimate);
};

/// All columns, in the order in which they are written; that of absolute time on request only.
[[nodiscard]] std::span<const EstimateColumn> estimate_columns(bool with_utc = false);

}  // namespace penduline
