// SPDX-License-Identifier: Apache-2.0
// Lines, bands and marks over time.
#include "host/plot/time_panel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "host/plot/pen.hpp"

namespace penduline {
namespace {

/// A middle value of those that are known.
double median(std::vector<double> values) {
  std::erase_if(values, [](double value) { return !std::isfinite(value); });
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

PenPath flagged_rows(const EstimateSeries& series) {
  PenPath path;
  for (std::size_t row = 0; row < series.size(); ++row) {
    if (series.answers(row) && !series.trusted(row)) {
      path.emplace_back(row);
    }
  }
  return path;
}

}  // namespace

std::string key_name(const std::vector<EstimateSeries>& inputs, std::size_t input) {
  return inputs.size() == 1 ? "" : inputs[input].name;
}

Panel time_panel(const std::vector<EstimateSeries>& inputs, const TimeColumn& column) {
  Panel panel{.x_label = "t / s",
              .y_label = fmt::format("{} / {}", column.name, column.unit),
              .key_above = true};
  std::string flagged_name = "flagged";  // once for all
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const EstimateSeries& series = inputs[i];
    if (!series.measures(column.values)) {
      continue;
    }
    const std::vector<double>& values = series.*column.values;
    const auto put = [&](const std::string& name, CurveStyle style, const PenPath& path) {
      panel.curves.push_back({.name = name,
                              .style = style,
                              .x = along(path, series.t_s),
                              .y = along(path, values, column.unit_size),
                              .colour = i,
                              .dash = i});
    };
    const PenPath path = pen_over(series.t_s, values, joined_rows(series));
    if (column.sigma != nullptr && any_known(series.*column.sigma)) {
      const std::vector<double>& sigma = series.*column.sigma;
      const std::string half_width =
          fmt::format("one sigma ({:.2g} {})", median(sigma) / column.unit_size, column.unit);
      put(inputs.size() == 1 ? half_width : "", CurveStyle::kBand, path);
      panel.curves.back().sigma_y = along(path, sigma, column.unit_size);
    }
    put(key_name(inputs, i), CurveStyle::kLine, path);
    if (const PenPath alone = lone_rows(path); !alone.empty()) {
      put("", CurveStyle::kPoints, alone);
    }
    if (const PenPath flagged = flagged_rows(series); !flagged.empty()) {
      put(std::exchange(flagged_name, ""), CurveStyle::kMarks, flagged);
      panel.curves.back().colour = kBlack;
    }
  }
  return panel;
}

}  // namespace penduline
