// SPDX-License-Identifier: Apache-2.0
// The live page with a recording inside, as one file.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace penduline {

/// What the page shows; each text but `rig_toml` and those of `analysis` is JSON already.
struct ReportParts {
  std::string session;
  std::string state;
  std::string recorded;  ///< see recorded_json
  std::vector<std::string> notes;
  std::vector<std::pair<std::string, std::string>> analysis;  ///< names and values, to be read
  std::string rig_toml;
  std::string points;
  double bin_s = 0;  ///< of which the points are the peaks; 0: they are all that there are
};

/// HTML that opens anywhere, loads nothing and runs nothing but the page's own script.
[[nodiscard]] std::string report_page(const ReportParts& parts);

}  // namespace penduline
