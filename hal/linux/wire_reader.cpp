// SPDX-License-Identifier: Apache-2.0
// Frames to samples; what else the board says is kept for the complaints.
#include "hal/linux/wire_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "common/wire/commands.hpp"
#include "common/wire/frame.hpp"
#include "common/wire/sample_message.hpp"

namespace penduline {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr milliseconds kPatienceForHello{3000};
constexpr milliseconds kLook{100};

}  // namespace

tl::expected<WireReader, Error> WireReader::open(const std::string& path) {
  auto stream = ByteStream::open(path);
  if (!stream) {
    return tl::unexpected(stream.error());
  }
  WireReader reader(std::move(*stream));
  if (const auto greeted = reader.greet(); !greeted) {
    return tl::unexpected(greeted.error());
  }
  return reader;
}

tl::expected<void, Error> WireReader::greet() {
  std::array<std::uint8_t, wire::kFrameBytes<wire::AskHello> + 1> question{};
  // A zero first: it ends what noise may stand in the board's buffer.
  const std::size_t size = wire::encode_frame(wire::AskHello{}, std::span(question).subspan(1));
  if (auto sent = stream_.write(std::span(question).first(size + 1)); !sent) {
    return sent;
  }
  const auto deadline = steady_clock::now() + kPatienceForHello;
  while (steady_clock::now() < deadline) {
    const auto frame = next_frame(kLook);
    if (!frame) {
      return tl::unexpected(frame.error());
    }
    if (*frame && (*frame)->type == wire::Hello::kType) {
      if (const auto hello = wire::read_message<wire::Hello>((*frame)->payload)) {
        note(*hello);
        return {};
      }
    }
    if (!*frame && ended_) {
      break;
    }
  }
  return failure(fmt::format("{}: found {}, expected a Penduline board that says Hello",
                             stream_.name(),
                             bytes_seen_ ? "bytes that are not its frames" : "no bytes"));
}

void WireReader::note(const wire::Hello& hello) {
  hello_ = hello;
  acquisition_ = {.rate_hz = hello.rate_millihz / 1e3,
                  .full_scale_counts = static_cast<double>(hello.full_scale_counts),
                  .reference_v = hello.reference_uv / 1e6,
                  .sensor_count = hello.sensor_count};
}

tl::expected<std::optional<wire::Frame>, Error> WireReader::next_frame(milliseconds patience) {
  const auto deadline = steady_clock::now() + patience;
  while (true) {
    while (begin_ < end_) {
      if (auto frame = decoder_.push(bytes_[begin_++])) {
        return frame;
      }
    }
    const auto left = std::chrono::ceil<milliseconds>(deadline - steady_clock::now());
    const auto got = stream_.read(bytes_, std::max(left, milliseconds(0)));
    if (!got) {
      return tl::unexpected(got.error());
    }
    if (got->outcome == ByteStream::Outcome::kEnd) {
      ended_ = true;
      return std::nullopt;
    }
    if (got->outcome == ByteStream::Outcome::kNothingYet && left <= milliseconds(0)) {
      return std::nullopt;
    }
    begin_ = 0;
    end_ = got->bytes;
    bytes_seen_ = bytes_seen_ || end_ > 0;
  }
}

tl::expected<bool, Error> WireReader::read(Sample& sample) {
  while (!ended_) {
    const auto frame = next_frame(kLook);
    if (!frame) {
      return tl::unexpected(frame.error());
    }
    if (!*frame) {
      continue;
    }
    if ((*frame)->type == wire::SampleMessage::kType) {
      if (const auto message = wire::read_message<wire::SampleMessage>((*frame)->payload)) {
        sample = wire::sample_of(*message);
        last_seq_ = sample.seq;
        return true;
      }
    } else if ((*frame)->type == wire::Status::kType) {
      if (const auto status = wire::read_message<wire::Status>((*frame)->payload)) {
        dropped_before_ = dropped_before_.value_or(status->dropped_frames);
        dropped_frames_ = status->dropped_frames - *dropped_before_;
      }
    }
  }
  return false;
}

std::string WireReader::place() const {
  return fmt::format("{}: seq {}", stream_.name(), last_seq_);
}

std::vector<std::string> WireReader::complaints() const {
  std::vector<std::string> complaints;
  if (decoder_.bad_frames() > 0) {
    complaints.push_back(
        fmt::format("{}: {} damaged frames", stream_.name(), decoder_.bad_frames()));
  }
  if (dropped_frames_ > 0) {
    complaints.push_back(fmt::format("{}: the board dropped {} frames that nobody read in time",
                                     stream_.name(), dropped_frames_));
  }
  return complaints;
}

}  // namespace penduline
