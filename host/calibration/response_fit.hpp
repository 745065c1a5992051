// SPDX-License-Identifier: Apache-2.0
// Fits one sensor's response to points of known gap.
#pragma once

#include <string>
#include <tl/expected.hpp>
#include <vector>

#include "common/response.hpp"
#include "hal/error.hpp"
#include "host/calibration/points_table.hpp"
#include "host/calibration/response_curve.hpp"
#include "host/calibration/response_model.hpp"
#include "host/fit/least_squares.hpp"

namespace penduline {

/// A response that its points could determine.
struct ResponseFit {
  Response<double> response;
  std::vector<std::string> names;  ///< of the fit's numbers
  Fit fit;
  GapRange range;            ///< of the points used
  double residual_m = 0;     ///< RMS
  std::size_t left_out = 0;  ///< points nearer than the peak allows
  std::vector<std::string> warnings;
  std::vector<SensorPoint> used;
  std::vector<double> residuals_m;  ///< of `used`
};

/// Fits a model to points in any order; of the rig's own `start` the gap of the peak is taken,
/// unless the points themselves show one. `name` stands for the sensor in messages. Fails, saying
/// why, where the points are too few, cover too little, or contradict the model.
[[nodiscard]] tl::expected<ResponseFit, Error> fit_response(std::vector<SensorPoint> points,
                                                            ResponseModel model,
                                                            const Response<double>& start,
                                                            const std::string& name);

}  // namespace penduline
