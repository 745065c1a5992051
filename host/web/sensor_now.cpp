// SPDX-License-Identifier: Apache-2.0
// From counts to volts and what they mean.
#include "host/web/sensor_now.hpp"

#include <algorithm>

namespace penduline {
namespace {

/// The flag is the sample's; a mean near the range's end says whose conversions it were.
std::optional<bool> is_saturated(const Sample& sample, double full_scale_counts, std::size_t i) {
  constexpr double kNearTheEnd = 0.9;
  if ((sample.flags & flag::kSaturated) == 0) {
    return false;
  }
  bool known = false;
  for (std::size_t sensor = 0; sensor < sample.readings.size(); ++sensor) {
    const Reading& reading = sample.readings[sensor];
    const bool high = sample.has_reading(sensor) &&
                      std::max(reading.on, reading.off) >= kNearTheEnd * full_scale_counts;
    if (high && sensor == i) {
      return true;
    }
    known = known || high;
  }
  return known ? std::optional(false) : std::nullopt;
}

}  // namespace

SensorNow sensor_now(const Rig<double>& rig, const Acquisition<double>& acquisition,
                     const Sample& sample, std::size_t i) {
  SensorNow now;
  if (!sample.has_reading(i)) {
    return now;
  }
  const Reading reading = sample.readings[i];
  now.signal_v = signal_v(reading, acquisition);
  if (reading.off != 0) {
    now.ambient_v = reading.off * acquisition.reference_v / acquisition.full_scale_counts;
  }
  now.saturated = is_saturated(sample, acquisition.full_scale_counts, i);
  now.out_of_range = (rig.responses[i].read(*now.signal_v).flags & flag::kOutOfRange) != 0;
  return now;
}

}  // namespace penduline
