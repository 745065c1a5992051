// SPDX-License-Identifier: Apache-2.0
// Responses from points at known tilts or known gaps.
#pragma once

#include <tl/expected.hpp>
#include <vector>

#include "hal/error.hpp"
#include "host/calibration/calibration.hpp"
#include "host/calibration/points_table.hpp"
#include "host/calibration/response_fit.hpp"
#include "host/rig_file.hpp"

namespace penduline {

/// Fits each sensor's response to its points. Fails where one sensor's cannot be determined.
[[nodiscard]] tl::expected<Calibration, Error> calibrate_static(const RigFile& rig,
                                                                const SensorPoints& points,
                                                                ResponseModel model);

/// The points, the curve and what they differ by, for figures of any method.
[[nodiscard]] std::vector<Panel> response_panels(const std::string& sensor,
                                                 const Response<double>& response,
                                                 const GapRange& range, const Curve& points);

/// Gaps in millimetres over signals in volts, as points.
[[nodiscard]] Curve points_curve(const std::vector<double>& gap_m,
                                 const std::vector<double>& volts);

}  // namespace penduline
