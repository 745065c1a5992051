// SPDX-License-Identifier: Apache-2.0
// One connection's life: frames from a board that has said who it is, and commands to it.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <tl/expected.hpp>
#include <utility>
#include <vector>

#include "common/wire/decoder.hpp"
#include "common/wire/frame.hpp"
#include "common/wire/messages.hpp"
#include "hal/linux/byte_port.hpp"

namespace penduline {

class BoardConnection {
 public:
  /// How long a board may take to say Hello.
  static constexpr std::chrono::milliseconds kPatienceForHello{3000};

  /// Asks the board who it is and waits for the answer. Fails where none comes in time, before the
  /// bytes end or before `give_up` says so, and where the answer is of a protocol that is too old.
  static tl::expected<BoardConnection, Error> open(std::unique_ptr<BytePort> port,
                                                   const std::function<bool()>& give_up);

  [[nodiscard]] const wire::Hello& hello() const { return hello_; }
  [[nodiscard]] const BytePort& port() const { return *port_; }

  /// The next frame, those kept since the Hello first; none where nothing came for so long or
  /// the bytes have ended. It is valid until the next call. Fails where the port has gone.
  tl::expected<std::optional<wire::Frame>, Error> next_frame(std::chrono::milliseconds patience);
  /// Whether the bytes have ended.
  [[nodiscard]] bool ended() const { return ended_; }

  /// Throws away what came before the Hello and replies: a board that nobody has read for long
  /// keeps what is old.
  void forget_kept_frames() { kept_.clear(); }

  /// Sends a command; does nothing where there is no way back.
  template <wire::Message Command>
  tl::expected<void, Error> send(const Command& command) {
    std::array<std::uint8_t, wire::kFrameBytes<Command> + 1> frame{};
    // A zero first: it ends what noise may stand in the board's buffer.
    const std::size_t size = wire::encode_frame(command, std::span(frame).subspan(1));
    return port_->write(std::span(frame).first(size + 1));
  }

  /// Sends a command and waits for its reply; what comes meanwhile is kept. Fails where none comes
  /// within a second.
  template <wire::Message Command>
  tl::expected<wire::Result, Error> request(Command command) {
    command.token = ++token_;
    if (const auto sent = send(command); !sent) {
      return tl::unexpected(sent.error());
    }
    return reply_to(Command::kType, command.token);
  }

  /// Frames that came damaged since the first that came whole: what stands before it is the rest of
  /// one that nobody has lost.
  [[nodiscard]] std::uint32_t damaged_frames() const;

 private:
  explicit BoardConnection(std::unique_ptr<BytePort> port) : port_(std::move(port)) {}
  tl::expected<void, Error> greet(const std::function<bool()>& give_up);
  tl::expected<wire::Result, Error> reply_to(std::uint8_t command, std::uint8_t token);
  void keep(const wire::Frame& frame);
  tl::expected<std::optional<wire::Frame>, Error> receive(std::chrono::milliseconds patience);

  /// A frame that waits for its turn.
  struct KeptFrame {
    std::uint8_t type = 0;
    std::vector<std::uint8_t> payload;
  };

  std::unique_ptr<BytePort> port_;
  wire::Decoder decoder_;
  std::array<std::uint8_t, 4096> bytes_{};
  std::size_t begin_ = 0;
  std::size_t end_ = 0;
  wire::Hello hello_;
  std::deque<KeptFrame> kept_;  ///< came before the Hello or a reply
  KeptFrame given_;             ///< the one of them that was given last
  std::uint8_t token_ = 0;
  std::optional<std::uint32_t> damaged_at_first_;
  bool bytes_seen_ = false;
  bool ended_ = false;
};

}  // namespace penduline
