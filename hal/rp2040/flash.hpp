// SPDX-License-Identifier: Apache-2.0
// The Pico's flash beside the program: a store in its last sector, and the chip's unique number.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "hal/concepts.hpp"

namespace penduline::rp2040 {

/// The last sector of the Pico's 2 MiB.
class FlashStore {
 public:
  [[nodiscard]] std::span<const std::uint8_t> contents() const;
  /// Takes some 50 ms, with interrupts off: the program cannot be read while the flash is written.
  bool replace(std::span<const std::uint8_t> block);
};

static_assert(Store<FlashStore>);

/// The flash chip's own number (its command 0x4b), read once at start-up.
class FlashId {
 public:
  void start();
  [[nodiscard]] std::array<std::uint8_t, kUniqueIdBytes> unique_id() const { return id_; }

 private:
  std::array<std::uint8_t, kUniqueIdBytes> id_{};
};

static_assert(UniqueId<FlashId>);

}  // namespace penduline::rp2040
