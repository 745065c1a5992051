// SPDX-License-Identifier: Apache-2.0
// Exchanges to events and back.
#include "host/session/clock_exchange.hpp"

#include <string>
#include <string_view>

namespace penduline {

RecordingEvent event_of(const ClockExchange& exchange) {
  return {.kind = std::string(event::kPong),
          .utc_us = exchange.utc_us,
          .fields = {{"sent_us", exchange.sent_us},
                     {"t_us", exchange.t_us},
                     {"received_us", exchange.received_us}}};
}

std::optional<ClockExchange> exchange_of(const RecordingEvent& event) {
  // What a recording's times may be, so that no sum of them overflows.
  constexpr std::int64_t kLargestUs = (std::int64_t{1} << 53U) - 1;
  const auto time_us = [&](std::string_view key) {
    const auto us = event.get<std::int64_t>(key);
    return us && *us >= 0 && *us <= kLargestUs ? us : std::nullopt;
  };
  const auto sent_us = time_us("sent_us");
  const auto t_us = time_us("t_us");
  const auto received_us = time_us("received_us");
  if (event.kind != event::kPong || !event.utc_us || !sent_us || !t_us || !received_us) {
    return std::nullopt;
  }
  return ClockExchange{
      .sent_us = *sent_us, .t_us = *t_us, .received_us = *received_us, .utc_us = *event.utc_us};
}

}  // namespace penduline
