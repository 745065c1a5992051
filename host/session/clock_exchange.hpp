// SPDX-License-Identifier: Apache-2.0
// One Ping and its Pong, and how a recording keeps them.
#pragma once

#include <cstdint>
#include <optional>

#include "hal/replay/recording_event.hpp"

namespace penduline {

/// All that one Ping and its Pong say about the clocks. The board's time needs no extension here:
/// the protocol sends 64 bits of it. No time is below 0 or above 2^53 - 1.
struct ClockExchange {
  std::int64_t sent_us = 0;      ///< host, CLOCK_MONOTONIC, right before the Ping was sent
  std::int64_t t_us = 0;         ///< board, when it read the Ping
  std::int64_t received_us = 0;  ///< host, CLOCK_MONOTONIC, when the Pong had come
  std::int64_t utc_us = 0;       ///< host, CLOCK_REALTIME, at the moment of `received_us`

  bool operator==(const ClockExchange&) const = default;
};

/// The exchange as an event `pong`. A replay that hands the exchanges to a DeviceClock in their
/// places has its every answer to the last bit.
[[nodiscard]] RecordingEvent event_of(const ClockExchange& exchange);

/// The exchange of an event; none where it is no `pong` or not a whole one.
[[nodiscard]] std::optional<ClockExchange> exchange_of(const RecordingEvent& event);

}  // namespace penduline
