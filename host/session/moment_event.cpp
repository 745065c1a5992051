// SPDX-License-Identifier: Apache-2.0
// The moment's fields.
#include "host/session/moment_event.hpp"

#include <cmath>
#include <cstdint>
#include <string>

namespace penduline {

RecordingEvent moment_event(std::string_view kind, const HostTime& moment,
                            const std::optional<DeviceClock>& clock) {
  RecordingEvent event{.kind = std::string(kind), .utc_us = moment.utc_us};
  event.fields.push_back({"host_us", moment.monotonic_us});
  if (const auto board = clock ? clock->board_moment(moment.monotonic_us) : std::nullopt) {
    event.fields.push_back({"t_us", board->t_us});
    event.fields.push_back(
        {"t_uncertainty_us", static_cast<std::int64_t>(std::ceil(board->uncertainty_us))});
  }
  return event;
}

}  // namespace penduline
