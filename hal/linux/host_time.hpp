// SPDX-License-Identifier: Apache-2.0
// The host's two clocks at one moment.
#pragma once

#include <cstdint>

namespace penduline {

struct HostTime {
  std::int64_t monotonic_us;  ///< CLOCK_MONOTONIC: never steps, stands still while the host sleeps
  std::int64_t utc_us;        ///< CLOCK_REALTIME, since 1970: steps when somebody sets it
};

/// Reads both clocks, as a rule within a microsecond of each other.
[[nodiscard]] HostTime host_time_now();

}  // namespace penduline
