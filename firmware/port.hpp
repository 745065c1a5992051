// SPDX-License-Identifier: Apache-2.0
// One link with what waits to go out on it and what comes in.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "common/wire/decoder.hpp"
#include "common/wire/frame.hpp"
#include "firmware/frame_ring.hpp"
#include "hal/concepts.hpp"

namespace penduline {

template <ByteLink Link>
class Port {
 public:
  explicit Port(Link& link) : link_(link) {}

  template <wire::Message Message>
  void send(const Message& message) {
    std::array<std::uint8_t, wire::kFrameBytes<Message>> frame{};
    send_frame({frame.data(), wire::encode_frame(message, frame)});
  }
  /// A frame that is encoded already.
  void send_frame(std::span<const std::uint8_t> frame) { waiting_.push(frame); }

  /// Hands the link what it has room for, each frame between two zeros of its own, so that one zero
  /// that is damaged costs one frame. A frame that has begun to go out is not dropped any more.
  void pump(std::uint64_t now_us) {
    while (true) {
      if (sent_ == size_) {
        sent_ = 0;
        const std::size_t frame = waiting_.pop(std::span(going_).subspan(1));
        size_ = frame == 0 ? 0 : frame + 1;
        if (size_ == 0) {
          return;
        }
      }
      const std::size_t taken = link_.write({going_.data() + sent_, size_ - sent_});
      if (taken == 0) {
        return;
      }
      sent_ += taken;
      last_sent_us_ = now_us;
    }
  }

  /// Calls `on_frame(const wire::Frame&)` for each frame that has come. Takes no more than there is
  /// room for the answers of, so that a flood waits at the host; but a host that has not read for a
  /// while is heard all the same. A call takes kMostPieces pieces at most, so that windows are not
  /// kept waiting.
  template <class OnFrame>
  void receive(std::uint64_t now_us, const OnFrame& on_frame) {
    constexpr std::uint64_t kDeafUs = 100'000;
    constexpr int kMostPieces = 16;
    const bool deaf = now_us - last_sent_us_ > kDeafUs;
    std::array<std::uint8_t, 32> piece{};
    for (int i = 0; i < kMostPieces && (deaf || waiting_.free_bytes() > Link::kWaitingBytes / 2);
         ++i) {
      const std::size_t size = link_.read(piece);
      if (size == 0) {
        return;
      }
      decoder_.push(std::span<const std::uint8_t>(piece).first(size), on_frame);
    }
  }

  [[nodiscard]] const Link& link() const { return link_; }
  [[nodiscard]] std::uint32_t dropped_frames() const { return waiting_.dropped(); }
  [[nodiscard]] std::uint32_t bad_frames() const { return decoder_.bad_frames(); }

 private:
  Link& link_;
  FrameRing<Link::kWaitingBytes> waiting_;
  std::array<std::uint8_t, 1 + wire::kMaxFrameBytes> going_{};  ///< a zero, then the frame
  std::size_t size_ = 0;
  std::size_t sent_ = 0;
  std::uint64_t last_sent_us_ = 0;
  wire::Decoder decoder_;
};

}  // namespace penduline
