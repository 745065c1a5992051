// SPDX-License-Identifier: Apache-2.0
// The list of the kinds of plots.
#include "host/plot/plot_kinds.hpp"

#include <array>

namespace penduline {
namespace {

constexpr std::array kKinds = {
    PlotKind{"angles", "both angles against time, with one sigma where it is known", angles_plot},
    PlotKind{"xyz", "the mass's position against time", xyz_plot},
    PlotKind{"top", "the mass's path from above, with the fitted ellipse", top_plot},
    PlotKind{"3d", "the mass's path in space", space_plot},
    PlotKind{"phase", "the rate of each angle against the angle", phase_plot},
    PlotKind{"spectrum", "the amplitude spectrum of each angle", spectrum_plot},
    PlotKind{"residuals", "each angle less that of the fitted simulation", residuals_plot},
};

}  // namespace

std::span<const PlotKind> plot_kinds() {
  return kKinds;
}

}  // namespace penduline
