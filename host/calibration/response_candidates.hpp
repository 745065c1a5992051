// SPDX-License-Identifier: Apache-2.0
// The ways to fit one sensor's points: a model and a degree each, as a problem of least squares.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "common/response.hpp"
#include "host/calibration/points_table.hpp"
#include "host/calibration/response_curve.hpp"
#include "host/calibration/response_model.hpp"
#include "host/fit/least_squares.hpp"

namespace penduline {

/// Points, and what a misfit in volts is in metres at each.
struct WeighedPoints {
  std::vector<SensorPoint> points;  ///< from near to far
  std::vector<double> steepness_v_per_m;
  GapRange range;
};

/// How many gaps differ; `points` are in order.
[[nodiscard]] std::size_t distinct_gaps(const std::vector<SensorPoint>& points);

/// One way to fit: parameters, residuals in standard deviations, and the response that comes of it.
struct ResponseCandidate {
  std::vector<FitParameter> parameters;
  FitResiduals residuals;
  /// None where the numbers make no response: the signal would not keep falling.
  std::function<std::optional<Response<double>>(const Eigen::VectorXd&)> response;
  /// The gap that the numbers give a point, less its own, in metres; its derivative by them is the
  /// curve's uncertainty.
  std::function<double(const Eigen::VectorXd&, std::size_t)> gap_misfit_m;
};

/// `model` in all degrees that the different gaps of `data` can tell; `data` must outlive them.
[[nodiscard]] std::vector<ResponseCandidate> candidates_for(ResponseModel model,
                                                            const WeighedPoints& data,
                                                            double peak_m);

}  // namespace penduline
