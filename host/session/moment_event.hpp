// SPDX-License-Identifier: Apache-2.0
// An event at a moment that the host saw.
#pragma once

#include <optional>
#include <string_view>

#include "hal/linux/host_time.hpp"
#include "hal/replay/recording_event.hpp"
#include "host/session/device_clock.hpp"

namespace penduline {

/// With the moment on the host's clocks; where `clock` knows it, on the board's as well, and how
/// far off that may be.
[[nodiscard]] RecordingEvent moment_event(std::string_view kind, const HostTime& moment,
                                          const std::optional<DeviceClock>& clock);

}  // namespace penduline
