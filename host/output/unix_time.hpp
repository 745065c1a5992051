// SPDX-License-Identifier: Apache-2.0
// The host's time of day, and an estimate's.
#pragma once

#include <chrono>

#include "common/estimate.hpp"

namespace penduline {

/// Seconds since 1970 in UTC, to the microsecond.
[[nodiscard]] inline double unix_time_s() {
  return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

/// What a message of an estimate is stamped with: the moment of the angles, where the host knows
/// it, else now.
[[nodiscard]] inline double timestamp_s(const Estimate<double>& estimate) {
  constexpr double kUsPerS = 1e6;
  return estimate.utc_us ? static_cast<double>(*estimate.utc_us) / kUsPerS : unix_time_s();
}

}  // namespace penduline
