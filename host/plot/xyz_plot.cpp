// SPDX-License-Identifier: Apache-2.0
// The mass's position against time.
#include "host/plot/plot_kinds.hpp"
#include "host/plot/positions.hpp"
#include "host/plot/time_panel.hpp"
#include "host/units.hpp"

namespace penduline {

tl::expected<Figure, Error> xyz_plot(const std::vector<EstimateSeries>& inputs,
                                     const PlotSettings& /*settings*/) {
  if (const auto known = require_positions(inputs); !known) {
    return tl::unexpected(known.error());
  }
  Figure figure{.title = "Position of the mass from the pivot", .stacked = true};
  for (const SeriesColumn& column : {SeriesColumn{"x", &EstimateSeries::x_m},
                                     {"y", &EstimateSeries::y_m},
                                     {"z", &EstimateSeries::z_m}}) {
    figure.panels.push_back(time_panel(inputs, {.name = std::string(column.name),
                                                .unit = "mm",
                                                .unit_size = kMillimetre,
                                                .values = column.values}));
  }
  return figure;
}

}  // namespace penduline
