// SPDX-License-Identifier: Apache-2.0
// From a window's conversions to a sample.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "common/sample.hpp"
#include "hal/window.hpp"

namespace penduline {

/// What a reading is scaled to.
inline constexpr std::uint32_t kFullScaleCounts = 65535;

/// Conversions of one channel added up.
struct CodeSum {
  std::uint32_t sum = 0;
  std::uint32_t count = 0;

  /// Their mean, scaled so that `top_code` is kFullScaleCounts, rounded; 0 of none.
  [[nodiscard]] std::int32_t counts(std::uint16_t top_code) const {
    if (count == 0) {
      return 0;
    }
    const std::uint64_t whole = std::uint64_t{count} * top_code;
    return static_cast<std::int32_t>((std::uint64_t{sum} * kFullScaleCounts + whole / 2) / whole);
  }
};

/// The sample of a window whose ADC reaches `top_code` and that lasts `window_us`. A lit or dark
/// mode knows no ambient light: lit, all conversions are the lit reading; dark, the bursts that
/// would have been lit are.
[[nodiscard]] inline Sample sample_of(const Window& window, std::uint64_t seq,
                                      std::uint16_t top_code, std::uint32_t window_us) {
  std::array<std::array<CodeSum, 2>, kChannels> sums{};
  std::uint16_t largest = 0;
  const std::uint16_t* code = window.codes.data();
  for (const Burst& burst : kBursts) {
    const std::size_t reading = burst.lit || window.mode == EmitterMode::kLit ? 1 : 0;
    for (std::size_t i = 0; i < kConversionsPerBurst; ++i, ++code) {
      CodeSum& sum = sums[(burst.first_channel + i) % kChannels][reading];
      sum.sum += *code;
      ++sum.count;
      largest = std::max(largest, *code);
    }
  }
  Sample sample{.seq = seq,
                .t_us = static_cast<std::int64_t>(window.due_us + window.late_us + window_us / 2)};
  for (std::size_t channel = 0; channel < kChannels; ++channel) {
    sample.readings[channel] = {.on = sums[channel][1].counts(top_code),
                                .off = sums[channel][0].counts(top_code)};
  }
  sample.flags = (largest >= top_code ? flag::kSaturated : 0) |
                 (window.lost_before > 0 ? flag::kOverrun : 0) |
                 (window.out_of_step ? flag::kLate : 0);
  return sample;
}

}  // namespace penduline
