// SPDX-License-Identifier: Apache-2.0
// The STM32F4's flash beside the program: a store in a sector of its own, and the chip's number.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "hal/concepts.hpp"
#include "hal/stm32f4/timer.hpp"

namespace penduline::stm32f4 {

/// Sector 3, the last of the small ones: 16 KiB, right behind the program (nucleo.ld).
class FlashStore {
 public:
  explicit FlashStore(Timer& timer) : timer_(timer) {}

  [[nodiscard]] std::span<const std::uint8_t> contents() const;
  /// Takes up to half a second, with interrupts off: the program cannot be read meanwhile.
  bool replace(std::span<const std::uint8_t> block);

 private:
  Timer& timer_;
};

static_assert(Store<FlashStore>);

/// The chip's own 96 bits (RM0090 39.1), folded to 64. All 0 where there is no chip.
class ChipId {
 public:
  [[nodiscard]] std::array<std::uint8_t, kUniqueIdBytes> unique_id() const;
};

static_assert(UniqueId<ChipId>);

}  // namespace penduline::stm32f4
