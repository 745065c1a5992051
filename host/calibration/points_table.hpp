// SPDX-License-Identifier: Apache-2.0
// The table of points at which the disc's tilt or the gaps are known.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <tl/expected.hpp>
#include <vector>

#include "common/disc_plane.hpp"
#include "hal/error.hpp"
#include "host/calibration/signal_log.hpp"

namespace penduline {

/// One row: what was known while so much was recorded.
struct KnownPoint {
  std::string place;                                         ///< "points.csv:3"
  std::string recording;                                     ///< its path
  double from_s = -std::numeric_limits<double>::infinity();  ///< device seconds
  double to_s = std::numeric_limits<double>::infinity();
  std::optional<Angles<double>> angles{};   ///< else `gap_m`
  std::array<double, kMaxSensors> gap_m{};  ///< of each sensor; NaN where not known
};

/// Reads a table (docs/formats.md). Recordings are looked for beside it; rows that name none are of
/// `recording`. The error names line and column.
[[nodiscard]] tl::expected<std::vector<KnownPoint>, Error> read_points(const std::string& path,
                                                                       const std::string& recording,
                                                                       std::size_t sensor_count);

/// What one sensor saw at a known gap.
struct SensorPoint {
  std::string place;
  std::optional<Angles<double>> angles{};
  double gap_m = 0;
  double volts = 0;
  double standard_error_v = 0;
};

/// Each sensor's points.
using SensorPoints = std::array<std::vector<SensorPoint>, kMaxSensors>;

/// Reads the recordings and takes the means; appends the recordings' complaints. The gaps of known
/// angles are the layout's. Fails where a point has fewer than five samples of a sensor, or the
/// disc moved meanwhile.
[[nodiscard]] tl::expected<SensorPoints, Error> measure_points(
    const std::vector<KnownPoint>& points, const SensorLayout<double>& layout,
    std::vector<std::string>& complaints);

}  // namespace penduline
