// SPDX-License-Identifier: Apache-2.0
// Samples and estimates as messages, and samples back.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>

#include "common/estimate.hpp"
#include "common/sample.hpp"
#include "common/wire/device_messages.hpp"

namespace penduline::wire {

/// The sensors that a `SampleMessage` has room for.
inline constexpr std::size_t kWireSensors = 2;

/// The sample in a message.
[[nodiscard]] constexpr Sample sample_of(const SampleMessage& message) {
  Sample sample{.seq = message.seq, .t_us = static_cast<std::int64_t>(message.t_us)};
  sample.readings[0] = {.on = message.x_on, .off = message.x_off};
  sample.readings[1] = {.on = message.y_on, .off = message.y_off};
  sample.flags = message.flags;
  return sample;
}

/// The message for a sample of two sensors. Nothing where it does not fit: a missing reading,
/// counts beyond 16 bits, a time before 0, flags that are not the device's.
[[nodiscard]] constexpr std::optional<SampleMessage> sample_message_of(const Sample& sample) {
  constexpr std::int32_t kMostCounts = std::numeric_limits<std::uint16_t>::max();
  bool fits = sample.t_us >= 0 && sample.flags <= std::numeric_limits<std::uint8_t>::max();
  for (std::size_t i = 0; i < kWireSensors; ++i) {
    const Reading& reading = sample.readings[i];
    fits = fits && sample.has_reading(i) && std::min(reading.on, reading.off) >= 0 &&
           std::max(reading.on, reading.off) <= kMostCounts;
  }
  if (!fits) {
    return std::nullopt;
  }
  const Reading& x = sample.readings[0];
  const Reading& y = sample.readings[1];
  return SampleMessage{.seq = sample.seq,
                       .t_us = static_cast<std::uint64_t>(sample.t_us),
                       .x_on = static_cast<std::uint16_t>(x.on),
                       .x_off = static_cast<std::uint16_t>(x.off),
                       .y_on = static_cast<std::uint16_t>(y.on),
                       .y_off = static_cast<std::uint16_t>(y.off),
                       .flags = static_cast<std::uint8_t>(sample.flags)};
}

/// The message for an estimate; NaN for what it does not know.
[[nodiscard]] inline AnglesMessage angles_message_of(const Estimate<float>& estimate) {
  constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
  constexpr Estimate<float>::Pair kNeither{.first = kNone, .second = kNone};
  const Angles<float> angles = estimate.attitude
                                   ? estimate.attitude->angles
                                   : Angles<float>{.theta1_rad = kNone, .theta2_rad = kNone};
  const auto omega_rad_s = estimate.omega_rad_s.value_or(kNeither);
  const auto sigma_rad = estimate.sigma_rad.value_or(kNeither);
  return {.seq = estimate.seq,
          .t_us = estimate.t_us,
          .theta1_rad = angles.theta1_rad,
          .theta2_rad = angles.theta2_rad,
          .residual_m = estimate.residual_m.value_or(kNone),
          .flags = estimate.flags,
          .omega1_rad_s = omega_rad_s.first,
          .omega2_rad_s = omega_rad_s.second,
          .sigma1_rad = sigma_rad.first,
          .sigma2_rad = sigma_rad.second};
}

}  // namespace penduline::wire
