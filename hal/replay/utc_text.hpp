// SPDX-License-Identifier: Apache-2.0
// Absolute times as people and TOML write them.
#pragma once

#include <toml++/toml.h>
#include <cstdint>
#include <string>

namespace penduline {

/// Microseconds since 1970 as RFC 3339 in UTC: "2026-11-21T07:00:00.000000Z". Of the years 1970 to
/// 9999; an earlier or later time becomes the nearest of them.
[[nodiscard]] std::string utc_text(std::int64_t utc_us);

/// The same in whole seconds: "2026-11-21T07:00:00Z".
[[nodiscard]] std::string utc_text_s(std::int64_t utc_us);

/// A time of TOML in microseconds since 1970, digits beyond them cut off; one without an offset is
/// in UTC.
[[nodiscard]] std::int64_t utc_us_of(const toml::date_time& time);

}  // namespace penduline
