// SPDX-License-Identifier: Apache-2.0
// Estimates as lines of text.
#include "host/output/estimate_writer.hpp"

#include "host/output/estimate_columns.hpp"
#include "host/output/fixed_decimals.hpp"

namespace penduline {
namespace {

/// Appends the columns as members of a JSON object, `separator` before the first.
void append_members(std::string& text, const Estimate<double>& estimate,
                    std::string_view separator) {
  for (const EstimateColumn& column : estimate_columns()) {
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

void append_estimate_head(std::string& text, EstimateFormat format) {
  if (format == EstimateFormat::kJsonLines) {
    return;
  }
  std::string_view separator;
  for (const EstimateColumn& column : estimate_columns()) {
    text += separator;
    text += column.name;
    separator = ",";
  }
  text += '\n';
}

void append_estimate_row(std::string& text, const Estimate<double>& estimate,
                         EstimateFormat format) {
  if (format == EstimateFormat::kJsonLines) {
    append_members(text, estimate, "{");
    text += "}\n";
    return;
  }
  std::string_view separator;
  for (const EstimateColumn& column : estimate_columns()) {
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
  append_members(text, estimate, ",");
  text += '}';
}

}  // namespace penduline
