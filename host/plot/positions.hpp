// SPDX-License-Identifier: Apache-2.0
// What plots of the mass's path need.
#pragma once

#include <fmt/format.h>

#include <tl/expected.hpp>
#include <vector>

#include "hal/error.hpp"
#include "host/plot/estimate_series.hpp"

namespace penduline {

/// Fails where a series says nothing of where the mass is.
[[nodiscard]] inline tl::expected<void, Error> require_positions(
    const std::vector<EstimateSeries>& inputs) {
  for (const EstimateSeries& series : inputs) {
    if (!any_known(series.x_m) || !any_known(series.y_m) || !any_known(series.z_m)) {
      return failure(fmt::format(
          "{}: found no positions, expected the columns x_m, y_m and z_m; or --rig, which tells "
          "the rod's length",
          series.name));
    }
  }
  return {};
}

}  // namespace penduline
