// SPDX-License-Identifier: Apache-2.0
// An analysis as panels of curves.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/analysis/analysis_report.hpp"
#include "host/units.hpp"

namespace penduline {
namespace {

std::vector<double> degrees(const std::vector<double>& radians) {
  std::vector<double> result(radians.size());
  std::ranges::transform(radians, result.begin(), [](double angle) { return angle / kDegree; });
  return result;
}

std::vector<double> degrees(const Eigen::VectorXd& radians) {
  return degrees(std::vector<double>(radians.begin(), radians.end()));
}

Panel angles_panel(const SwingAnalysis& analysis) {
  const AngleSeries& series = analysis.series;
  Panel panel{.title = "Angles", .x_label = "t / s", .y_label = "angle / deg", .curves = {}};
  const auto add = [&](const std::string& name, const std::vector<double>& measured,
                       const std::vector<double>& simulated) {
    panel.curves.push_back(
        {.name = name, .style = CurveStyle::kPoints, .x = series.t_s, .y = degrees(measured)});
    panel.curves.push_back({.name = name + ", model", .x = series.t_s, .y = degrees(simulated)});
  };
  add(series.planar ? "theta" : "theta1", series.theta1_rad, analysis.simulated.theta1_rad);
  if (!series.planar) {
    add("theta2", series.theta2_rad, analysis.simulated.theta2_rad);
  }
  return panel;
}

Panel residuals_panel(const SwingAnalysis& analysis) {
  const AngleSeries& series = analysis.series;
  const SwingFit& fit = analysis.friction.chosen;
  Panel panel{.title = "Experiment less simulation",
              .x_label = "t / s",
              .y_label = "residual / deg",
              .curves = {}};
  panel.curves.push_back({.name = series.planar ? "theta" : "theta1",
                          .style = CurveStyle::kPoints,
                          .x = series.t_s,
                          .y = degrees(fit.residual1_rad)});
  if (!series.planar) {
    panel.curves.push_back({.name = "theta2",
                            .style = CurveStyle::kPoints,
                            .x = series.t_s,
                            .y = degrees(fit.residual2_rad)});
  }
  return panel;
}

Panel decay_panel(const SwingAnalysis& analysis) {
  Curve measured{.name = "measured", .style = CurveStyle::kErrorBars, .x = {}, .y = {}};
  Curve model{.name = "model: " + name_of(analysis.friction.chosen.terms), .x = {}, .y = {}};
  for (const DecayPoint& point : analysis.decay) {
    measured.x.push_back(point.t_s);
    measured.y.push_back(point.semi_major_rad.value / kDegree);
    measured.sigma_y.push_back(point.semi_major_rad.sigma / kDegree);
    model.x.push_back(point.t_s);
    model.y.push_back(point.model_semi_major_rad / kDegree);
  }
  return {.title = "Decay of the amplitude",
          .x_label = "t / s",
          .y_label = "semi-major axis / deg",
          .curves = {measured, model}};
}

Panel period_panel(const SwingAnalysis& analysis) {
  Curve measured{.name = "measured", .style = CurveStyle::kErrorBars, .x = {}, .y = {}};
  Curve theory{.name = "theory", .x = {}, .y = {}};
  if (analysis.period) {
    for (const PeriodPoint& point : analysis.period->points) {
      measured.x.push_back(point.amplitude_rad / kDegree);
      measured.y.push_back(point.period_s.value);
      measured.sigma_y.push_back(point.period_s.sigma);
      theory.x.push_back(point.amplitude_rad / kDegree);
      theory.y.push_back(point.theory_s);
    }
  }
  return {.title = "Period against amplitude",
          .x_label = "amplitude / deg",
          .y_label = "period / s",
          .curves = {measured, theory}};
}

Panel path_panel(const SwingAnalysis& analysis) {
  const auto path = [](const std::string& name, CurveStyle style, const AngleSeries& series) {
    Curve curve{.name = name, .style = style, .x = {}, .y = {}};
    for (std::size_t i = 0; i < series.size(); ++i) {
      const TiltPoint point = tilt_point(series.theta1_rad[i], series.theta2_rad[i]);
      curve.x.push_back(point.x_rad / kDegree);
      curve.y.push_back(point.y_rad / kDegree);
    }
    return curve;
  };
  Curve ellipse{.name = "first ellipse", .x = {}, .y = {}};
  const TiltPoint centre = tilt_point(analysis.friction.chosen.model.zero.x_rad,
                                      analysis.friction.chosen.model.zero.y_rad);
  constexpr int kCorners = 72;
  const double turn = analysis.orientation_rad->value;
  for (int i = 0; i <= kCorners; ++i) {
    const double phase = 2 * std::numbers::pi * i / kCorners;
    const double along = analysis.semi_major_rad.value * std::cos(phase);
    const double across = analysis.semi_minor_rad.value * std::sin(phase);
    ellipse.x.push_back((centre.x_rad + along * std::cos(turn) - across * std::sin(turn)) /
                        kDegree);
    ellipse.y.push_back((centre.y_rad + along * std::sin(turn) + across * std::cos(turn)) /
                        kDegree);
  }
  return {.title = "The path from above",
          .x_label = "tilt towards X / deg",
          .y_label = "tilt towards Y / deg",
          .curves = {path("measured", CurveStyle::kPoints, analysis.series),
                     path("model", CurveStyle::kLine, analysis.simulated), ellipse},
          .equal_scales = true};
}

}  // namespace

Figure analysis_figure(const SwingAnalysis& analysis) {
  Figure figure{.panels = {angles_panel(analysis), residuals_panel(analysis), decay_panel(analysis),
                           period_panel(analysis)}};
  if (!analysis.series.planar) {
    figure.panels.push_back(path_panel(analysis));
  }
  return figure;
}

}  // namespace penduline
