// SPDX-License-Identifier: Apache-2.0
// An analysis for a person, for a program, and as a figure.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "host/analysis/swing_analysis.hpp"
#include "host/figure/figure.hpp"

namespace penduline {

/// What a physicist reads: a figure a line with its uncertainty, and what it is compared with.
[[nodiscard]] std::string analysis_text(const SwingAnalysis& analysis, const std::string& file);

/// Names and values of the same, without its tables: "Period: of small swings", "1.0995 +- 0.0002
/// s".
using AnalysisFigures = std::vector<std::pair<std::string, std::string>>;
[[nodiscard]] AnalysisFigures analysis_figures(const SwingAnalysis& analysis);

/// One JSON object; keys in docs/formats.md. What is not known is null.
[[nodiscard]] std::string analysis_json(const SwingAnalysis& analysis, const std::string& file);

/// Angles with the model, residuals, decay, period against amplitude and, of a swing in two
/// dimensions, the path from above.
[[nodiscard]] Figure analysis_figure(const SwingAnalysis& analysis);

}  // namespace penduline
