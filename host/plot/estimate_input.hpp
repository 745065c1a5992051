// SPDX-License-Identifier: Apache-2.0
// Reading what is to be drawn: a table of estimates, or a recording that becomes one.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <tl/expected.hpp>

#include "common/rig.hpp"
#include "hal/error.hpp"
#include "host/estimator/estimator.hpp"
#include "host/plot/estimate_series.hpp"

namespace penduline {

/// Reads a table that `read_angle_table` reads, with all other columns of estimates that it has.
/// Fails as that does.
[[nodiscard]] tl::expected<EstimateSeries, Error> read_estimate_table(const std::string& path);

/// The estimates of a recording, as a replay gives them. `warn` is told, once for each kind, what
/// is doubtful. Fails as reading does, where the rig does not suit, and where the board's clock
/// starts anew.
[[nodiscard]] tl::expected<EstimateSeries, Error> estimates_of_recording(
    const std::string& path, const Rig<double>& rig, const EstimatorOptions& options,
    const std::function<void(const std::string&)>& warn);

/// What a plot may have besides its files.
struct EstimateInput {
  std::optional<Rig<double>> rig{};  ///< needed for recordings; tells a table the rod's length
  EstimatorOptions estimator{};
};

/// Whichever of both `path` is, called by the file's name. A table without positions gets them
/// where there is a rig.
[[nodiscard]] tl::expected<EstimateSeries, Error> read_estimates(
    const std::string& path, const EstimateInput& input,
    const std::function<void(const std::string&)>& warn);

}  // namespace penduline
