// SPDX-License-Identifier: Apache-2.0
// A mean is not at the range's end, but near it, when only some of its conversions are.
#include "host/saturation.hpp"

#include <algorithm>

#include "common/flags.hpp"

namespace penduline {

std::optional<bool> is_saturated(const Sample& sample, double full_scale_counts,
                                 std::size_t sensor) {
  constexpr double kNearTheEnd = 0.9;
  if ((sample.flags & flag::kSaturated) == 0) {
    return false;
  }
  bool known = false;
  for (std::size_t i = 0; i < sample.readings.size(); ++i) {
    const Reading& reading = sample.readings[i];
    const bool high = sample.has_reading(i) &&
                      std::max(reading.on, reading.off) >= kNearTheEnd * full_scale_counts;
    if (high && i == sensor) {
      return true;
    }
    known = known || high;
  }
  return known ? std::optional(false) : std::nullopt;
}

}  // namespace penduline
