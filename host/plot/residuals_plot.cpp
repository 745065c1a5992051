// SPDX-License-Identifier: Apache-2.0
// Each angle less that of the fitted simulation.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/analysis/swing_analysis.hpp"
#include "host/plot/pen.hpp"
#include "host/plot/plot_kinds.hpp"
#include "host/plot/time_panel.hpp"
#include "host/units.hpp"

namespace penduline {
namespace {

Curve residual_curve(const std::string& name, const std::vector<double>& t_s,
                     const Eigen::VectorXd& residual_rad) {
  const std::vector<double> values(residual_rad.begin(), residual_rad.end());
  const PenPath path = pen_over(t_s, values, std::vector<bool>(t_s.size(), true));
  const double rms_deg =
      std::sqrt(residual_rad.squaredNorm() / static_cast<double>(residual_rad.size())) / kDegree;
  return {.name = fmt::format("{} RMS {:.2g} deg",
                              name.empty() ? "experiment less simulation," : name + ":", rms_deg),
          .style = CurveStyle::kPoints,
          .x = along(path, t_s),
          .y = along(path, values, kDegree)};
}

Panel residual_panel(const std::string& angle) {
  return {
      .x_label = "t / s", .y_label = fmt::format("residual of {} / deg", angle), .key_above = true};
}

}  // namespace

tl::expected<Figure, Error> residuals_plot(const std::vector<EstimateSeries>& inputs,
                                           const PlotSettings& settings) {
  const bool planar = std::ranges::all_of(inputs, &EstimateSeries::planar);
  Figure figure{.panels = {residual_panel(planar ? "theta" : "theta1")},
                .title = "Experiment less the fitted simulation",
                .stacked = true};
  if (!planar) {
    figure.panels.push_back(residual_panel("theta2"));
  }
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const EstimateSeries& series = inputs[i];
    const auto analysis =
        analyze_swing(series.angles(), {.from_s = settings.from_s, .to_s = settings.to_s});
    if (!analysis) {
      return failure(fmt::format("{}: {}", series.name, analysis.error().message));
    }
    const SwingFit& fit = analysis->friction.chosen;
    const auto put = [&](Panel& panel, const Eigen::VectorXd& residual_rad) {
      panel.curves.push_back(
          residual_curve(key_name(inputs, i), analysis->series.t_s, residual_rad));
      panel.curves.back().colour = i;
    };
    put(figure.panels.front(), fit.residual1_rad);
    if (!series.planar) {
      put(figure.panels.back(), fit.residual2_rad);
    }
  }
  return figure;
}

}  // namespace penduline
