// SPDX-License-Identifier: Apache-2.0
// Frames that wait for a link: whole ones only, and the oldest give way to the newest.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace penduline {

/// A ring of frames of up to 255 bytes each, in `Bytes` bytes of memory.
template <std::size_t Bytes>
class FrameRing {
 public:
  /// Puts a frame in; drops and counts as many of the oldest as it needs the room of.
  void push(std::span<const std::uint8_t> frame) {
    if (frame.empty() || frame.size() > kLongestFrame || frame.size() + 1 > Bytes) {
      ++dropped_;
      return;
    }
    while (Bytes - used_ < frame.size() + 1) {
      drop_oldest();
      ++dropped_;
    }
    put(static_cast<std::uint8_t>(frame.size()));
    for (const std::uint8_t byte : frame) {
      put(byte);
    }
  }

  /// Takes the oldest frame out into `out`, which has room for any; returns its size, 0 of none.
  std::size_t pop(std::span<std::uint8_t> out) {
    if (used_ == 0) {
      return 0;
    }
    const std::size_t size = take();
    for (std::size_t i = 0; i < size; ++i) {
      out[i] = take();
    }
    return size;
  }

  [[nodiscard]] std::size_t free_bytes() const { return Bytes - used_; }
  /// Frames that had to give way, since the start.
  [[nodiscard]] std::uint32_t dropped() const { return dropped_; }

 private:
  static constexpr std::size_t kLongestFrame = 255;

  void put(std::uint8_t byte) {
    bytes_[(first_ + used_) % Bytes] = byte;
    ++used_;
  }
  std::uint8_t take() {
    const std::uint8_t byte = bytes_[first_];
    first_ = (first_ + 1) % Bytes;
    --used_;
    return byte;
  }
  void drop_oldest() {
    const std::size_t size = take();
    first_ = (first_ + size) % Bytes;
    used_ -= size;
  }

  static_assert((Bytes & (Bytes - 1)) == 0, "a power of two, so that no division is needed");
  std::array<std::uint8_t, Bytes> bytes_{};
  std::size_t first_ = 0;
  std::size_t used_ = 0;
  std::uint32_t dropped_ = 0;
};

}  // namespace penduline
