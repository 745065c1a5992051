// SPDX-License-Identifier: Apache-2.0
// CRC-32/ISO-HDLC, the one of zlib, Ethernet and PNG, four bits at a time.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace penduline::wire {

/// What each value of four bits does to the remainder; the polynomial is 0x04C11DB7, reflected.
inline constexpr std::array<std::uint32_t, 16> kCrcOfNibble = [] {
  std::array<std::uint32_t, 16> table{};
  for (std::uint32_t nibble = 0; nibble < table.size(); ++nibble) {
    std::uint32_t remainder = nibble;
    for (int bit = 0; bit < 4; ++bit) {
      remainder = (remainder >> 1U) ^ ((remainder & 1U) != 0 ? 0xEDB88320U : 0U);
    }
    table[nibble] = remainder;
  }
  return table;
}();

/// The CRC of `bytes`. Given the CRC of what stands before them, that of both together.
[[nodiscard]] constexpr std::uint32_t crc32(std::span<const std::uint8_t> bytes,
                                            std::uint32_t before = 0) {
  std::uint32_t remainder = ~before;
  for (const std::uint8_t byte : bytes) {
    remainder ^= byte;
    remainder = (remainder >> 4U) ^ kCrcOfNibble[remainder & 0xFU];
    remainder = (remainder >> 4U) ^ kCrcOfNibble[remainder & 0xFU];
  }
  return ~remainder;
}

}  // namespace penduline::wire
