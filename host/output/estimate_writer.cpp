// SPDX-License-Identifier: Apache-2.0
// Estimates as lines of text.
#include "host/output/estimate_writer.hpp"

#include "host/output/estimate_columns.hpp"
#include "host/output/fixed_decimals.hpp"

namespace penduline {

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
  const bool json = format == EstimateFormat::kJsonLines;
  std::string_view separator = json ? "{" : "";
  for (const EstimateColumn& column : estimate_columns()) {
    text += separator;
    separator = ",";
    if (json) {
      text += '"';
      text += column.name;
      text += "\":";
    }
    if (const auto value = column.value(estimate)) {
      append_fixed(text, *value, column.decimals);
    } else if (json) {
      text += "null";
    }
  }
  text += json ? "}\n" : "\n";
}

}  // namespace penduline
