// SPDX-License-Identifier: Apache-2.0
// Whether a board is there, may be talked to, and what it says of itself.
#pragma once

#include <optional>

#include "common/wire/device_messages.hpp"
#include "host/doctor/finding.hpp"
#include "host/doctor/typed_commands.hpp"
#include "host/session/stop_signal.hpp"
#include "host/source/source_uri.hpp"

namespace penduline {

/// Looks for the board of a URI (`serial:`, `usb:` or `auto`), opens it and asks who it is and how
/// it fares. Ends with the first finding that is bad, or where a stop is requested.
[[nodiscard]] Findings check_board(const SourceUri& uri, const TypedNames& names,
                                   const StopSignal& stop);

/// What a board says of how it fares; none: it did not answer. A simulated board's load says
/// nothing.
[[nodiscard]] Finding check_health(const wire::Hello& hello,
                                   const std::optional<wire::Status>& status,
                                   const TypedNames& names);

}  // namespace penduline
