// SPDX-License-Identifier: Apache-2.0
// Both angles against time.
#include <algorithm>

#include "host/plot/plot_kinds.hpp"
#include "host/plot/time_panel.hpp"
#include "host/units.hpp"

namespace penduline {

tl::expected<Figure, Error> angles_plot(const std::vector<EstimateSeries>& inputs,
                                        const PlotSettings& /*settings*/) {
  const bool planar = std::ranges::all_of(inputs, &EstimateSeries::planar);
  Figure figure{.panels = {time_panel(inputs, {.name = planar ? "theta" : "theta1",
                                               .unit = "deg",
                                               .unit_size = kDegree,
                                               .values = &EstimateSeries::theta1_rad,
                                               .sigma = &EstimateSeries::sigma1_rad})},
                .title = "Angles",
                .stacked = true};
  if (!planar) {
    figure.panels.push_back(time_panel(inputs, {.name = "theta2",
                                                .unit = "deg",
                                                .unit_size = kDegree,
                                                .values = &EstimateSeries::theta2_rad,
                                                .sigma = &EstimateSeries::sigma2_rad}));
  }
  return figure;
}

}  // namespace penduline
