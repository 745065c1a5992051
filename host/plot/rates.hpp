// SPDX-License-Identifier: Apache-2.0
// Rates of angles that no estimator has said.
#pragma once

#include <vector>

#include "host/plot/estimate_series.hpp"

namespace penduline {

/// For each row the slope between its neighbours, if it is joined to both; else NaN. Swings of the
/// angular frequency w, sampled every T, come out smaller by the factor sin(w T) / (w T).
[[nodiscard]] std::vector<double> central_differences(const EstimateSeries& series,
                                                      const std::vector<double>& values);

}  // namespace penduline
