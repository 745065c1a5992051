// SPDX-License-Identifier: Apache-2.0
// A sample: one paired reading of all sensors, as the device sent it and as a recording keeps it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "common/flags.hpp"

namespace penduline {

#ifndef PENDULINE_MAX_SENSORS
#define PENDULINE_MAX_SENSORS 8  // a board's build says fewer, to save memory
#endif

/// The most sensors that one rig may have.
inline constexpr std::size_t kMaxSensors = PENDULINE_MAX_SENSORS;

/// Mean counts of one sensor over the sampling window.
struct Reading {
  std::int32_t on = 0;   ///< with the emitter lit
  std::int32_t off = 0;  ///< with the emitter dark (ambient light), 0 where it cannot be switched
};

/// One paired reading of all sensors.
struct Sample {
  std::uint64_t seq = 0;  ///< counted on the device from 0, never repeated within one boot
  std::int64_t t_us = 0;  ///< device clock at the middle of the sampling window
  std::array<Reading, kMaxSensors> readings{};
  std::uint32_t missing = 0;  ///< bit i set: sensor i has no reading in this sample
  Flags flags = 0;            ///< the device's own (bits 0..7)

  [[nodiscard]] constexpr bool has_reading(std::size_t sensor) const {
    return ((missing >> sensor) & 1U) == 0;
  }
};

/// What holds for all samples of a stream: how the device takes them.
template <class Scalar>
struct Acquisition {
  Scalar rate_hz = 20;
  Scalar full_scale_counts = 65535;
  Scalar reference_v = Scalar(3.3);
  std::size_t sensor_count = 2;

  bool operator==(const Acquisition&) const = default;

  /// The nominal period, rounded; of a rate of 1 mHz or more it fits 32 bits.
  [[nodiscard]] constexpr std::int64_t period_us() const {
    return static_cast<std::int32_t>(Scalar(1e6) / rate_hz + Scalar(0.5));
  }
  /// What two samples in a row may be apart: one and a half periods.
  [[nodiscard]] constexpr std::int64_t longest_step_us() const {
    return static_cast<std::int32_t>(Scalar(1.5e6) / rate_hz) + 1;
  }
};

/// A sensor's signal in volts: what its emitter adds to the ambient light. Slightly negative where
/// nothing reflects and the noise says so.
template <class Scalar>
[[nodiscard]] constexpr Scalar signal_v(Reading reading, const Acquisition<Scalar>& acquisition) {
  // Counts fit 16 bits; the difference of what fills 32 is taken after the conversion. A conversion
  // of 64 bits would bring double arithmetic to the board.
  const std::int64_t wide = std::int64_t{reading.on} - reading.off;
  const auto narrow = static_cast<std::int32_t>(wide);
  const Scalar difference =
      narrow == wide ? static_cast<Scalar>(narrow)
                     : static_cast<Scalar>(reading.on) - static_cast<Scalar>(reading.off);
  return difference * (acquisition.reference_v / acquisition.full_scale_counts);
}

}  // namespace penduline
