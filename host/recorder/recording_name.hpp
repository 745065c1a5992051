// SPDX-License-Identifier: Apache-2.0
// The names of a recording's files: dated by the user's pattern, numbered where that is not enough.
#pragma once

#include <cstdint>
#include <string>

namespace penduline {

/// The path with strftime's conversions (%Y, %m, %d, %H, %M, %S, ...; %% is a percent sign) filled
/// in, in UTC; as it is where it has no percent sign.
[[nodiscard]] std::string dated_name(const std::string& path, std::int64_t utc_us);

/// The path with a number before its extension: "rec.csv" and 7 give "rec-0007.csv".
[[nodiscard]] std::string numbered_name(const std::string& path, unsigned number);

/// One more than the largest number with which `numbered_name` gives a file that is there; 1 where
/// there is none.
[[nodiscard]] unsigned next_number(const std::string& path);

}  // namespace penduline
