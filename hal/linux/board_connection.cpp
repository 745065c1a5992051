// SPDX-License-Identifier: Apache-2.0
// Bytes to frames; the Hello at the beginning.
#include "hal/linux/board_connection.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "common/wire/frame.hpp"

namespace penduline {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr milliseconds kLook{100};

}  // namespace

tl::expected<BoardConnection, Error> BoardConnection::open(std::unique_ptr<BytePort> port,
                                                           const std::function<bool()>& give_up) {
  BoardConnection connection(std::move(port));
  if (const auto greeted = connection.greet(give_up); !greeted) {
    return tl::unexpected(greeted.error());
  }
  return connection;
}

tl::expected<void, Error> BoardConnection::greet(const std::function<bool()>& give_up) {
  if (auto sent = send(wire::AskHello{}); !sent) {
    return sent;
  }
  const auto deadline = steady_clock::now() + kPatienceForHello;
  while (steady_clock::now() < deadline && !ended_ && !give_up()) {
    const auto frame = receive(kLook);
    if (!frame) {
      return tl::unexpected(frame.error());
    }
    if (!*frame) {
      continue;
    }
    if ((*frame)->type != wire::Hello::kType) {
      keep(**frame);
      continue;
    }
    const auto hello = wire::read_message<wire::Hello>((*frame)->payload);
    if (!hello) {
      return failure(fmt::format(
          "{}: found a Hello of {} bytes, expected {} or more: its firmware is too old; flash it",
          port_->name(), (*frame)->payload.size(), wire::kPayloadBytes<wire::Hello>));
    }
    hello_ = *hello;
    return {};
  }
  return failure(fmt::format("{}: found {}, expected a Penduline board that says Hello",
                             port_->name(),
                             bytes_seen_ ? "bytes that are not its frames" : "no bytes"));
}

void BoardConnection::keep(const wire::Frame& frame) {
  constexpr std::size_t kMostFrames = 4096;  // a board keeps some fifty while nobody reads
  if (kept_.size() < kMostFrames) {
    kept_.push_back({frame.type, {frame.payload.begin(), frame.payload.end()}});
  }
}

tl::expected<wire::Result, Error> BoardConnection::reply_to(std::uint8_t command,
                                                            std::uint8_t token) {
  constexpr milliseconds kPatience{1000};
  const auto deadline = steady_clock::now() + kPatience;
  while (steady_clock::now() < deadline && !ended_) {
    const auto frame = receive(kLook);
    if (!frame) {
      return tl::unexpected(frame.error());
    }
    if (*frame && (*frame)->type == wire::Reply::kType) {
      const auto reply = wire::read_message<wire::Reply>((*frame)->payload);
      if (reply && reply->command == command && reply->token == token) {
        return reply->result;
      }
    } else if (*frame) {
      keep(**frame);
    }
  }
  return failure(fmt::format("{}: the board does not answer a command", port_->name()));
}

tl::expected<std::optional<wire::Frame>, Error> BoardConnection::next_frame(milliseconds patience) {
  if (kept_.empty()) {
    return receive(patience);
  }
  given_ = std::move(kept_.front());
  kept_.pop_front();
  return wire::Frame{.type = given_.type, .payload = given_.payload};
}

tl::expected<std::optional<wire::Frame>, Error> BoardConnection::receive(milliseconds patience) {
  const auto deadline = steady_clock::now() + patience;
  bool read_some = false;
  while (true) {
    while (begin_ < end_) {
      if (auto frame = decoder_.push(bytes_[begin_++])) {
        damaged_at_first_ = damaged_at_first_.value_or(decoder_.bad_frames());
        return frame;
      }
    }
    const auto left = std::chrono::ceil<milliseconds>(deadline - steady_clock::now());
    if (read_some && left <= milliseconds(0)) {
      return std::nullopt;  // bytes come and come, none of them a frame's
    }
    const auto got = port_->read(bytes_, std::max(left, milliseconds(0)));
    if (!got) {
      return tl::unexpected(got.error());
    }
    if (got->outcome == BytePort::Outcome::kEnd) {
      ended_ = true;
      return std::nullopt;
    }
    if (got->outcome == BytePort::Outcome::kNothingYet) {
      return std::nullopt;  // also after a signal
    }
    begin_ = 0;
    end_ = got->bytes;
    bytes_seen_ = read_some = true;
  }
}

std::uint32_t BoardConnection::damaged_frames() const {
  return decoder_.bad_frames() - damaged_at_first_.value_or(decoder_.bad_frames());
}

}  // namespace penduline
