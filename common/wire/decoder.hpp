// SPDX-License-Identifier: Apache-2.0
// Frames out of a stream of bytes that may begin anywhere and be damaged anywhere.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "common/wire/frame.hpp"

namespace penduline::wire {

/// Gathers bytes up to the next zero and opens what they are. A damaged, cut or overlong frame is
/// counted and costs nothing beyond its own zero. Not for an interrupt: opening takes 255 CRC
/// steps.
class Decoder {
 public:
  /// Takes one byte. The frame that it ends, if any, is valid until the next byte is taken.
  [[nodiscard]] constexpr std::optional<Frame> push(std::uint8_t byte) {
    if (byte != 0) {
      if (size_ < encoded_.size()) {
        encoded_[size_] = byte;
      }
      size_ = size_ <= encoded_.size() ? size_ + 1 : size_;
      return std::nullopt;
    }
    const std::size_t size = size_;
    size_ = 0;
    if (size == 0) {
      return std::nullopt;
    }
    const auto frame = size <= encoded_.size() ? open_frame(std::span(encoded_).first(size))
                                               : std::optional<Frame>();
    if (!frame) {
      ++bad_frames_;
    }
    return frame;
  }

  /// Takes many bytes; `on_frame(const Frame&)` is called for each frame that ends among them.
  template <class OnFrame>
  constexpr void push(std::span<const std::uint8_t> bytes, const OnFrame& on_frame) {
    for (const std::uint8_t byte : bytes) {
      if (const auto frame = push(byte)) {
        on_frame(*frame);
      }
    }
  }

  /// Frames that were damaged, cut or overlong; what came before the first zero may be one.
  [[nodiscard]] constexpr std::uint32_t bad_frames() const { return bad_frames_; }

 private:
  std::array<std::uint8_t, kMaxEncodedBytes> encoded_{};
  std::size_t size_ = 0;  ///< one more than there is room for: overlong
  std::uint32_t bad_frames_ = 0;
};

}  // namespace penduline::wire
