// SPDX-License-Identifier: Apache-2.0
// The host's time of day.
#pragma once

#include <chrono>

namespace penduline {

/// Seconds since 1970 in UTC, to the microsecond.
[[nodiscard]] inline double unix_time_s() {
  return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

}  // namespace penduline
