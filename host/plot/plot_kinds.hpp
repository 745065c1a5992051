// SPDX-License-Identifier: Apache-2.0
// The kinds of plots: one list for the program, its help and the tests.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <vector>

#include "hal/error.hpp"
#include "host/figure/figure.hpp"
#include "host/plot/estimate_series.hpp"

namespace penduline {

struct PlotSettings {
  /// The part that the series were cut to, where one was asked for.
  std::optional<double> from_s{};
  std::optional<double> to_s{};
  /// Told what a figure lacks.
  std::function<void(const std::string&)> warn;
};

/// Draws one or more series over each other; each has angles. Fails, naming the series, where one
/// lacks what the kind needs.
using MakePlot = tl::expected<Figure, Error> (*)(const std::vector<EstimateSeries>& inputs,
                                                 const PlotSettings& settings);

/// Both angles against time, with a band of one sigma where it is known.
[[nodiscard]] tl::expected<Figure, Error> angles_plot(const std::vector<EstimateSeries>& inputs,
                                                      const PlotSettings& settings);
/// The mass's position against time.
[[nodiscard]] tl::expected<Figure, Error> xyz_plot(const std::vector<EstimateSeries>& inputs,
                                                   const PlotSettings& settings);
/// The mass's path from above, with the ellipses of the first and the last free swing.
[[nodiscard]] tl::expected<Figure, Error> top_plot(const std::vector<EstimateSeries>& inputs,
                                                   const PlotSettings& settings);
/// The mass's path in space and its shadow on the floor.
[[nodiscard]] tl::expected<Figure, Error> space_plot(const std::vector<EstimateSeries>& inputs,
                                                     const PlotSettings& settings);
/// The rate of each angle against the angle.
[[nodiscard]] tl::expected<Figure, Error> phase_plot(const std::vector<EstimateSeries>& inputs,
                                                     const PlotSettings& settings);
/// The amplitude spectrum of each angle.
[[nodiscard]] tl::expected<Figure, Error> spectrum_plot(const std::vector<EstimateSeries>& inputs,
                                                        const PlotSettings& settings);
/// Each angle less that of the fitted simulation.
[[nodiscard]] tl::expected<Figure, Error> residuals_plot(const std::vector<EstimateSeries>& inputs,
                                                         const PlotSettings& settings);

struct PlotKind {
  std::string_view name;
  std::string_view meaning;
  MakePlot make;
};

/// All kinds, in the order in which the help lists them.
[[nodiscard]] std::span<const PlotKind> plot_kinds();

}  // namespace penduline
