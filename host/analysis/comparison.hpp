// SPDX-License-Identifier: Apache-2.0
// An experiment against the simulation of it that starts from the same state.
#pragma once

#include "host/analysis/swing_fit.hpp"

namespace penduline {

/// What experiment and simulation differ by.
struct Comparison {
  double rms_rad = 0;
  double max_rad = 0;
  double max_at_s = 0;
  double next_correlation = 0;  ///< of each residual with the next
  double most_correlation = 0;  ///< of the largest size at lags up to a period
  double most_correlation_lag_s = 0;
  double white_limit = 0;  ///< what noise alone stays below, 19 times of 20
  double repetition =
      1;  ///< the figures' variances count residuals that repeat each other so often once
  Measured delay_s;  ///< by which the experiment lags behind the simulation
};

/// Of the series that was fitted.
[[nodiscard]] Comparison compare_with_simulation(const AngleSeries& series, const SwingFit& fit);

}  // namespace penduline
