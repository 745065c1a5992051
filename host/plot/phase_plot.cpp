// SPDX-License-Identifier: Apache-2.0
// The rate of each angle against the angle.
#include <fmt/format.h>

#include <algorithm>

#include "host/plot/pen.hpp"
#include "host/plot/plot_kinds.hpp"
#include "host/plot/rates.hpp"
#include "host/plot/time_panel.hpp"
#include "host/units.hpp"

namespace penduline {
namespace {

struct AngleAndRate {
  std::string name;
  std::vector<double> EstimateSeries::*angle_rad;
  std::vector<double> EstimateSeries::*rate_rad_s;
};

Panel phase_panel(const std::vector<EstimateSeries>& inputs, const AngleAndRate& columns) {
  Panel panel{.x_label = fmt::format("{} / deg", columns.name),
              .y_label = fmt::format("rate of {} / (deg/s)", columns.name),
              .key_above = true};
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const EstimateSeries& series = inputs[i];
    if (!series.measures(columns.angle_rad)) {
      continue;
    }
    const bool told = any_known(series.*columns.rate_rad_s);
    const std::vector<double> rates =
        told ? series.*columns.rate_rad_s : central_differences(series, series.*columns.angle_rad);
    const auto put = [&](const std::string& name, CurveStyle style, const PenPath& path) {
      panel.curves.push_back({.name = name,
                              .style = style,
                              .x = along(path, series.*columns.angle_rad, kDegree),
                              .y = along(path, rates, kDegree),
                              .colour = i,
                              .dash = i,
                              .line_width = kThin});
    };
    // All rows: over the angle, which goes to and fro, there are no columns to thin out.
    const PenPath path = pen_through(rates, joined_rows(series));
    const std::string origin = told ? "the estimator's rate" : "rate by differences";
    put(inputs.size() == 1 ? origin : fmt::format("{}, {}", series.name, origin), CurveStyle::kLine,
        path);
    if (const PenPath alone = lone_rows(path); !alone.empty()) {
      put("", CurveStyle::kPoints, alone);
    }
  }
  return panel;
}

}  // namespace

tl::expected<Figure, Error> phase_plot(const std::vector<EstimateSeries>& inputs,
                                       const PlotSettings& /*settings*/) {
  for (const EstimateSeries& series : inputs) {
    const bool told = any_known(series.omega1_rad_s);
    if (!told && !any_known(central_differences(series, series.theta1_rad))) {
      return failure(fmt::format(
          "{}: found no rates and no three rows in succession, from which they would follow",
          series.name));
    }
  }
  const bool planar = std::ranges::all_of(inputs, &EstimateSeries::planar);
  Figure figure{.panels = {phase_panel(inputs, {.name = planar ? "theta" : "theta1",
                                                .angle_rad = &EstimateSeries::theta1_rad,
                                                .rate_rad_s = &EstimateSeries::omega1_rad_s})},
                .title = "Phase portrait"};
  if (!planar) {
    figure.panels.push_back(phase_panel(inputs, {.name = "theta2",
                                                 .angle_rad = &EstimateSeries::theta2_rad,
                                                 .rate_rad_s = &EstimateSeries::omega2_rad_s}));
  }
  return figure;
}

}  // namespace penduline
