// SPDX-License-Identifier: Apache-2.0
// A sampling window: which conversions it is made of, and how they become a sample's readings.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "common/wire/choices.hpp"

namespace penduline {

/// The two analogue channels of a board, in the order of a recording's columns.
inline constexpr std::size_t kChannels = 2;

using wire::EmitterMode;

/// A burst of conversions: both channels in turn, beginning with one of them.
struct Burst {
  bool lit;  ///< in the mode kSwitched
  std::uint8_t first_channel;
};

/// The bursts of a window. It reads the same backwards, light and channels, so that the means of
/// both channels, lit and dark, all refer to its middle.
inline constexpr std::array<Burst, 4> kBursts = {{{false, 0}, {true, 0}, {true, 1}, {false, 1}}};

/// Of each burst, half of them on each channel.
inline constexpr std::size_t kConversionsPerBurst = 32;
inline constexpr std::size_t kConversionsPerWindow = kBursts.size() * kConversionsPerBurst;
/// Averaged for one lit or one dark reading of one channel.
inline constexpr std::size_t kConversionsPerReading = kConversionsPerWindow / (2 * kChannels);

/// What the sensors' light and current take to settle after the emitters are switched, with margin
/// (docs/hardware.md, "The phototransistor's load").
inline constexpr std::uint32_t kSettlingUs = 150;

/// How long a window lasts whose conversions take `conversion_ns` each.
[[nodiscard]] constexpr std::uint32_t window_us(std::uint32_t conversion_ns) {
  return 2 * kSettlingUs + static_cast<std::uint32_t>(kConversionsPerWindow) * conversion_ns / 1000;
}

/// A window that takes longer than its length by more than this share was held up: its readings do
/// not refer to one moment. A power of two.
inline constexpr std::uint32_t kHeldUpShare = 8;

/// One window's conversions, as the board took them.
struct Window {
  std::uint64_t due_us = 0;   ///< when it was to begin
  std::uint32_t late_us = 0;  ///< by how much later its first conversion began
  bool out_of_step = false;   ///< it began too late, or was held up: see `kHeldUpShare`
  EmitterMode mode = EmitterMode::kSwitched;
  std::uint32_t lost_before = 0;  ///< windows that were due before this one and not taken
  std::array<std::uint16_t, kConversionsPerWindow> codes{};  ///< burst by burst
};

}  // namespace penduline
