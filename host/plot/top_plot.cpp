// SPDX-License-Identifier: Apache-2.0
// The mass's path from above, and ellipses through single swings.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "host/analysis/free_span.hpp"
#include "host/analysis/swing_ellipse.hpp"
#include "host/plot/pen.hpp"
#include "host/plot/plot_kinds.hpp"
#include "host/plot/positions.hpp"
#include "host/plot/time_panel.hpp"
#include "host/units.hpp"

namespace penduline {
namespace {

/// How far the mass is from the pivot, by the first row that tells.
double rod_length_m(const EstimateSeries& series) {
  std::size_t row = 0;
  while (!std::isfinite(series.x_m[row])) {
    ++row;
  }
  return std::hypot(series.x_m[row], series.y_m[row], series.z_m[row]);
}

/// The mass's path for an ellipse of tilts (analysis.md eq. 1 and 2).
Curve ellipse_curve(const std::string& name, const SwingEllipse& ellipse, double length_m) {
  constexpr int kCorners = 144;
  Curve curve{.name = fmt::format("{}: {:.2f} x {:.2f} deg", name,
                                  ellipse.semi_major_rad.value / kDegree,
                                  std::abs(ellipse.semi_minor_rad.value) / kDegree)};
  const double turn = ellipse.orientation_rad.value;
  for (int i = 0; i <= kCorners; ++i) {
    const double phase = 2 * std::numbers::pi * i / kCorners;
    const double along = ellipse.semi_major_rad.value * std::cos(phase);
    const double across = ellipse.semi_minor_rad.value * std::sin(phase);
    const double x = ellipse.centre.x_rad + along * std::cos(turn) - across * std::sin(turn);
    const double y = ellipse.centre.y_rad + along * std::sin(turn) + across * std::cos(turn);
    const double tilt = std::hypot(x, y);
    const double per_tilt = tilt > 0 ? length_m * std::sin(tilt) / tilt : length_m;
    curve.x.push_back(per_tilt * x / kMillimetre);
    curve.y.push_back(per_tilt * y / kMillimetre);
  }
  return curve;
}

/// Ellipses of the first and the last free swing, the latter where only one series is drawn.
void put_ellipses(Panel& panel, const std::vector<EstimateSeries>& inputs, std::size_t input,
                  const PlotSettings& settings) {
  const EstimateSeries& series = inputs[input];
  const AngleSeries angles = series.angles();
  const auto span = find_free_span(angles);
  const auto swings =
      span ? swing_ellipses(
                 angles.between(span->from_s, span->to_s),
                 {.period_s = span->period_s, .step_s = span->period_s, .rest = {}, .noise = {}})
           : std::vector<SwingEllipse>{};
  if (swings.empty()) {
    settings.warn(fmt::format("{}: no ellipse: {}", series.name,
                              span ? "too few samples a swing" : span.error().message));
    return;
  }
  const double length_m = rod_length_m(series);
  const bool alone = inputs.size() == 1;
  panel.curves.push_back(ellipse_curve(alone ? "first swing" : series.name + ", first swing",
                                       swings.front(), length_m));
  panel.curves.back().colour = alone ? 1 : input;
  panel.curves.back().dash = 1;
  if (alone && swings.size() > 1) {
    panel.curves.push_back(ellipse_curve("last swing", swings.back(), length_m));
    panel.curves.back().colour = kBlack;
    panel.curves.back().dash = 2;
  }
}

}  // namespace

tl::expected<Figure, Error> top_plot(const std::vector<EstimateSeries>& inputs,
                                     const PlotSettings& settings) {
  if (const auto known = require_positions(inputs); !known) {
    return tl::unexpected(known.error());
  }
  Panel panel{.x_label = "x / mm", .y_label = "y / mm", .equal_scales = true, .key_above = true};
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const auto put = [&](const std::string& name, CurveStyle style, const PenPath& path) {
      panel.curves.push_back({.name = name,
                              .style = style,
                              .x = along(path, inputs[i].x_m, kMillimetre),
                              .y = along(path, inputs[i].y_m, kMillimetre),
                              .colour = i,
                              .line_width = kThin});
    };
    const PenPath path = pen_in_space(inputs[i]);
    put(inputs.size() == 1 ? "path" : inputs[i].name, CurveStyle::kLine, path);
    if (const PenPath alone = lone_rows(path); !alone.empty()) {
      put("", CurveStyle::kPoints, alone);
    }
  }
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    put_ellipses(panel, inputs, i, settings);
  }
  return Figure{.panels = {panel},
                .title = "Path of the mass from above",
                .size = FigureSize{.width_px = 620, .height_px = 620}};
}

}  // namespace penduline
