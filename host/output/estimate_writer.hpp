// SPDX-License-Identifier: Apache-2.0
// Writes estimates as text, one line each: CSV or JSON lines.
#pragma once

#include <string>
#include <string_view>

#include "common/estimate.hpp"

namespace penduline {

enum class EstimateFormat {
  kCsv,        ///< a line of names, then rows; what an estimate does not have is an empty cell
  kJsonLines,  ///< one object a line; what an estimate does not have is null
};

struct EstimateLayout {
  EstimateFormat format = EstimateFormat::kCsv;
  bool utc = false;  ///< with the column of absolute time
};

/// Appends what stands before the first estimate.
void append_estimate_head(std::string& text, const EstimateLayout& layout);

/// Appends one estimate as a line.
void append_estimate_row(std::string& text, const Estimate<double>& estimate,
                         const EstimateLayout& layout);

/// Appends one estimate as a JSON object with no line's end: `timestamp`, which is `unix_s` in
/// seconds since 1970, then the columns without that of absolute time.
void append_estimate_message(std::string& text, const Estimate<double>& estimate, double unix_s);

}  // namespace penduline
