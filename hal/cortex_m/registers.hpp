// SPDX-License-Identifier: Apache-2.0
// Registers by their address, and the processor's own (ARMv6-M and ARMv7-M B3.2).
#pragma once

#include <cstdint>

namespace penduline::cortex_m {

/// A register by its address.
[[nodiscard]] inline volatile std::uint32_t& reg(std::uint32_t address) {
  return *reinterpret_cast<volatile std::uint32_t*>(address);  // NOLINT: this is what an address is
}

/// Reads a register for what the reading does.
inline std::uint32_t read(std::uint32_t address) {
  return reg(address);
}

/// Waits until a register shows some of the bits; false after so many looks that it never will.
[[nodiscard]] inline bool wait_for(std::uint32_t address, std::uint32_t bits,
                                   std::uint32_t looks = 1'000'000) {
  while (looks-- > 0) {
    if ((read(address) & bits) != 0) {
      return true;
    }
  }
  return false;
}

}  // namespace penduline::cortex_m
