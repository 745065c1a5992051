// SPDX-License-Identifier: Apache-2.0
// COBS: bytes rewritten without a zero, so that a zero can end a frame.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace penduline::wire {

/// A block of this code holds 254 bytes and, unlike all others, no zero after them.
inline constexpr std::uint8_t kFullBlock = 0xFF;

/// The most bytes that `cobs_encode` makes of `size`: one for every 254 begun, at least one.
[[nodiscard]] constexpr std::size_t cobs_bound(std::size_t size) {
  return size + (size == 0 ? 1 : (size + 253) / 254);
}

/// Encodes by Consistent Overhead Byte Stuffing (Cheshire and Baker, 1999), without the zero that
/// ends a frame. Returns the bytes written; 0 where `out` is too small, which `cobs_bound` never
/// is.
[[nodiscard]] constexpr std::size_t cobs_encode(std::span<const std::uint8_t> in,
                                                std::span<std::uint8_t> out) {
  if (out.empty()) {
    return 0;
  }
  std::size_t code_at = 0;
  std::size_t size = 1;
  std::uint8_t code = 1;
  for (std::size_t i = 0; i < in.size(); ++i) {
    if (size == out.size()) {
      return 0;
    }
    if (in[i] != 0) {
      out[size++] = in[i];
      ++code;
    }
    // A full block at the very end needs no empty one after it.
    const bool full = code == kFullBlock && i + 1 < in.size();
    if (in[i] == 0 || full) {
      if (size == out.size()) {
        return 0;
      }
      out[code_at] = code;
      code_at = size++;
      code = 1;
    }
  }
  out[code_at] = code;
  return size;
}

/// Undoes `cobs_encode`. `out` may begin where `in` does: it is never ahead. Returns the bytes
/// written; nothing where `in` is empty, holds a zero or ends within a block, or `out` is too
/// small.
[[nodiscard]] constexpr std::optional<std::size_t> cobs_decode(std::span<const std::uint8_t> in,
                                                               std::span<std::uint8_t> out) {
  if (in.empty()) {
    return std::nullopt;
  }
  std::size_t next = 0;
  std::size_t size = 0;
  while (next < in.size()) {
    const std::uint8_t code = in[next++];
    const bool zero_follows = code != kFullBlock && next + code - 1 < in.size();
    if (code == 0 || next + code - 1 > in.size() ||
        size + code - 1 + (zero_follows ? 1 : 0) > out.size()) {
      return std::nullopt;
    }
    for (std::uint8_t i = 1; i < code; ++i) {
      const std::uint8_t byte = in[next++];
      if (byte == 0) {
        return std::nullopt;
      }
      out[size++] = byte;
    }
    if (zero_follows) {
      out[size++] = 0;
    }
  }
  return size;
}

}  // namespace penduline::wire
