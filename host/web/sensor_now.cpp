// SPDX-License-Identifier: Apache-2.0
// From counts to volts and what they mean.
#include "host/web/sensor_now.hpp"

#include <algorithm>

namespace penduline {

SensorNow sensor_now(const Rig<double>& rig, const Acquisition<double>& acquisition,
                     const Sample& sample, std::size_t i) {
  // The flag is the sample's; a mean near the range's end says whose conversions it were.
  constexpr double kNearTheEnd = 0.9;
  SensorNow now;
  if (!sample.has_reading(i)) {
    return now;
  }
  const Reading reading = sample.readings[i];
  now.signal_v = signal_v(reading, acquisition);
  if (reading.off != 0) {
    now.ambient_v = reading.off * acquisition.reference_v / acquisition.full_scale_counts;
  }
  const bool high =
      std::max(reading.on, reading.off) >= kNearTheEnd * acquisition.full_scale_counts;
  now.saturated = (sample.flags & flag::kSaturated) != 0 && high;
  now.out_of_range = (rig.responses[i].read(*now.signal_v).flags & flag::kOutOfRange) != 0;
  return now;
}

}  // namespace penduline
