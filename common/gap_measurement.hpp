// SPDX-License-Identifier: Apache-2.0
// Gaps with their uncertainties, as a Kalman filter takes them from a sample.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "common/disc_plane.hpp"
#include "common/flags.hpp"
#include "common/rig.hpp"
#include "common/sample.hpp"

namespace penduline {

/// A gap as a sensor has read it.
template <class Scalar>
struct GapMeasurement {
  std::size_t sensor = 0;  ///< in the layout's order
  Scalar gap_m = 0;
  Scalar variance_m2 = 0;
};

/// The gaps of one sample that can be used.
template <class Scalar>
struct GapMeasurements {
  std::array<GapMeasurement<Scalar>, kMaxSensors> gap{};
  std::size_t count = 0;
};

/// Reads a sample's gaps, each with what its sensor's noise makes of it (method.md eq. 29). One
/// that is missing, saturated, beyond its response's range or from beside the disc is left out and
/// flagged.
template <class Scalar>
[[nodiscard]] GapMeasurements<Scalar> measure_gaps(const Rig<Scalar>& rig,
                                                   const Acquisition<Scalar>& acquisition,
                                                   const Sample& sample, Flags& flags) {
  GapMeasurements<Scalar> measured;
  for (std::size_t i = 0; i < rig.layout.count; ++i) {
    if (!sample.has_reading(i)) {
      flags |= flag::kMissing;
      continue;
    }
    const Scalar volts = signal_v(sample.readings[i], acquisition);
    const Response<Scalar>& response = rig.responses[i];
    const GapReading<Scalar> reading = response.read(volts);
    Flags against = reading.flags;
    if (reading.gap_m && !beam_meets_disc(rig.layout, i, *reading.gap_m, rig.disc_diameter_m)) {
      against |= flag::kOutOfRange;
    }
    flags |= against;
    if (!reading.gap_m || against != 0 || (sample.flags & flag::kSaturated) != 0) {
      continue;
    }
    const Scalar by_volts = response.slope_m_per_v(volts) * rig.noise[i].volts;
    measured.gap[measured.count++] = {
        .sensor = i,
        .gap_m = *reading.gap_m,
        .variance_m2 = by_volts * by_volts + rig.noise[i].gap_m * rig.noise[i].gap_m};
  }
  return measured;
}

}  // namespace penduline
