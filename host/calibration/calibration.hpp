// SPDX-License-Identifier: Apache-2.0
// What every calibration comes to.
#pragma once

#include <string>
#include <vector>

#include "host/calibration_section.hpp"
#include "host/figure/figure.hpp"
#include "host/rig_writer.hpp"

namespace penduline {

/// A calibration that its data could determine.
struct Calibration {
  RigChanges changes;
  CalibrationRecord record;           ///< without its date
  std::vector<std::string> notes;     ///< what a user should read
  std::vector<std::string> warnings;  ///< what a user should doubt
  Figure figure;
};

/// Volts a metre: how steep a response is at a gap.
[[nodiscard]] inline double steepness_v_per_m(const Response<double>& response, double gap_m) {
  constexpr double kStepM = 1e-6;
  return (response.volts(gap_m + kStepM) - response.volts(gap_m - kStepM)) / (2 * kStepM);
}

/// The nearest gap whose signal tells it from one beyond the peak; 0 where no peak is known.
[[nodiscard]] inline double nearest_readable_m(const Response<double>& response) {
  return Response<double>::kPeakMargin * response.peak_m;
}

}  // namespace penduline
