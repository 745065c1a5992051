// SPDX-License-Identifier: Apache-2.0
// The mass's path in space.
#include <algorithm>
#include <cmath>

#include "host/plot/pen.hpp"
#include "host/plot/plot_kinds.hpp"
#include "host/plot/positions.hpp"
#include "host/plot/time_panel.hpp"
#include "host/units.hpp"

namespace penduline {
namespace {

/// The height of a floor below all paths.
double floor_mm(const std::vector<Curve>& paths) {
  double least = HUGE_VAL;
  double most = -HUGE_VAL;
  for (const Curve& path : paths) {
    for (const double z : path.z) {
      if (std::isfinite(z)) {
        least = std::min(least, z);
        most = std::max(most, z);
      }
    }
  }
  constexpr double kShare = 0.3;  // of the paths' height
  constexpr double kLeastMm = 0.05;
  return least - std::max(kShare * (most - least), kLeastMm);
}

}  // namespace

tl::expected<Figure, Error> space_plot(const std::vector<EstimateSeries>& inputs,
                                       const PlotSettings& /*settings*/) {
  if (const auto known = require_positions(inputs); !known) {
    return tl::unexpected(known.error());
  }
  std::vector<Curve> paths;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const auto put = [&](const std::string& name, CurveStyle style, const PenPath& path) {
      paths.push_back({.name = name,
                       .style = style,
                       .x = along(path, inputs[i].x_m, kMillimetre),
                       .y = along(path, inputs[i].y_m, kMillimetre),
                       .z = along(path, inputs[i].z_m, kMillimetre),
                       .colour = i,
                       .line_width = kThin});
    };
    const PenPath path = pen_in_space(inputs[i]);
    put(inputs.size() == 1 ? "path" : inputs[i].name, CurveStyle::kLine, path);
    if (const PenPath alone = lone_rows(path); !alone.empty()) {
      put("", CurveStyle::kPoints, alone);
    }
  }
  Panel panel{.x_label = "x / mm", .y_label = "y / mm", .z_label = "z / mm", .key_above = true};
  const double below_mm = floor_mm(paths);
  for (const Curve& path : paths) {
    Curve shadow = path;
    shadow.name = &path == &paths.front() ? "seen from above" : "";
    shadow.colour = kGrey;
    std::ranges::fill(shadow.z, below_mm);
    panel.curves.push_back(shadow);
  }
  panel.curves.insert(panel.curves.end(), paths.begin(), paths.end());
  return Figure{.panels = {panel},
                .title = "Path of the mass in space",
                .size = FigureSize{.width_px = 720, .height_px = 620}};
}

}  // namespace penduline
