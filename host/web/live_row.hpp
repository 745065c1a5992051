// SPDX-License-Identifier: Apache-2.0
// One moment of a session as the live page draws it.
#pragma once

#include <array>
#include <limits>

#include "common/flags.hpp"
#include "common/sample.hpp"

namespace penduline {

inline constexpr double kNotKnown = std::numeric_limits<double>::quiet_NaN();

/// One number a sensor, none of them known.
[[nodiscard]] constexpr std::array<double, kMaxSensors> none_known() {
  std::array<double, kMaxSensors> numbers{};
  numbers.fill(kNotKnown);
  return numbers;
}

/// kNotKnown where there is none.
struct LiveRow {
  double t_s = 0;  ///< of the session, see SessionTime
  double theta1_rad = kNotKnown;
  double theta2_rad = kNotKnown;
  double sigma1_rad = kNotKnown;
  double sigma2_rad = kNotKnown;
  double x_m = kNotKnown;
  double y_m = kNotKnown;
  double z_m = kNotKnown;
  std::array<double, kMaxSensors> signal_v = none_known();
  std::array<double, kMaxSensors> gap_m = none_known();
  Flags flags = 0;
};

}  // namespace penduline
