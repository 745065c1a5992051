// SPDX-License-Identifier: Apache-2.0
// A column of estimates against time, in a panel.
#pragma once

#include <string>
#include <vector>

#include "host/figure/figure.hpp"
#include "host/plot/estimate_series.hpp"

namespace penduline {

/// Of lines that lie close together: paths of many swings.
inline constexpr double kThin = 0.7;

/// What is drawn against time.
struct TimeColumn {
  std::string name;  ///< of the quantity
  std::string unit;
  double unit_size = 1;
  std::vector<double> EstimateSeries::*values = nullptr;
  std::vector<double> EstimateSeries::*sigma = nullptr;  ///< none: no band
};

/// A line for each series, broken where there is no answer; a row without neighbours is a point,
/// one with a flag against it is marked.
[[nodiscard]] Panel time_panel(const std::vector<EstimateSeries>& inputs, const TimeColumn& column);

/// How a curve of a series is called: not at all where there is only one.
[[nodiscard]] std::string key_name(const std::vector<EstimateSeries>& inputs, std::size_t input);

}  // namespace penduline
