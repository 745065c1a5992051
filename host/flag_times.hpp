// SPDX-License-Identifier: Apache-2.0
// When each flag was seen last.
#pragma once

#include <array>
#include <cstddef>

#include "common/flags.hpp"

namespace penduline {

/// Moments in seconds, in the order of kFlagDescriptions; 0 where a flag was not seen.
using FlagTimes = std::array<double, kFlagDescriptions.size()>;

/// Takes `t_s` for each flag of `flags`.
inline void note_flags(FlagTimes& latest_s, Flags flags, double t_s) {
  for (std::size_t i = 0; flags != 0 && i < kFlagDescriptions.size(); ++i) {
    latest_s[i] = (flags & kFlagDescriptions[i].bit) != 0 ? t_s : latest_s[i];
  }
}

}  // namespace penduline
