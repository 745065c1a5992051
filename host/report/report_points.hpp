// SPDX-License-Identifier: Apache-2.0
// A report's numbers, as its page reads them.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "host/web/live_row.hpp"

namespace penduline {

/// The columns of docs/web_protocol.md's `points` as one JSON object, each of them the base64 of
/// little-endian numbers: t_s of 64-bit floats, flags of 32-bit integers, the others of 32-bit
/// floats, NaN where there is no answer.
[[nodiscard]] std::string report_points(std::span<const LiveRow> rows, std::size_t sensors);

}  // namespace penduline
