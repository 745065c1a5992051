// SPDX-License-Identifier: Apache-2.0
// Estimates as lines of text.
#include "host/output/estimate_writer.hpp"

#include <span>

#include "host/output/estimate_columns.hpp"
#include "host/output/fixed_decimals.hpp"

namespace penduline {
namespace {

/// Appends columns as members of a JSON object, `separator` before the first.
void append_members(std::string& text, std::span<const EstimateColumn> columns,
                    const Estimate<double>& estimate, std::string_view separator) {
  for (const EstimateColumn& column : columns) {
    text += separator;
    separator = ",";
    text += '"';
    text += column.name;
    text += "\":";
    if (const auto value = column.value(estimate)) {
      append_fixed(text, *value, column.decimals);
    } else {
      text += "null";
    }
  }
}

}  // namespace

void append_estimate_head(std::string& text, const EstimateLayout& layout) {
  if (layout.format == EstimateFormat::kJsonLines) {
    return;
  }
  std::string_view separator;
  for (const EstimateColumn& column : estimate_columns(layout.utc)) {
    text += separator;
    text += column.name;
    separator = ",";
  }
  text += '\n';
}

void append_estimate_row(std::string& text, const Estimate<double>& estimate,
                         const EstimateLayout& layout) {
  const auto columns = estimate_columns(layout.utc);
  if (layout.format == EstimateFormat::kJsonLines) {
    append_members(text, columns, estimate, "{");
    text += "}\n";
    return;
  }
  std::string_view separator;
  for (const EstimateColumn& column : columns) {
    text += separator;
    separator = ",";
    if (const auto value = column.value(estimate)) {
      append_fixed(text, *value, column.decimals);
    }
  }
  text += '\n';
}

void append_estimate_message(std::string& text, const Estimate<double>& estimate, double unix_s) {
  constexpr std::size_t kTimestampDecimals = 6;
  text += "{\"timestamp\":";
  append_fixed(text, unix_s, kTimestampDecimals);
  append_members(text, estimate_columns(), estimate, ",");
  text += '}';
}

}  // namespace penduline
