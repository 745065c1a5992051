// SPDX-License-Identifier: Apache-2.0
// From counts to volts and what they mean.
#include "host/web/sensor_now.hpp"

#include "host/saturation.hpp"

namespace penduline {

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
