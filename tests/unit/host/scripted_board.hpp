// SPDX-License-Identifier: Apache-2.0
// A board that says what a test has written down, life after life, and notes what it is told.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "common/wire/decoder.hpp"
#include "common/wire/frame.hpp"
#include "host/source/board_source.hpp"

namespace penduline::test {

template <class Message>
std::string frame_of(const Message& message) {
  std::vector<std::uint8_t> bytes(wire::kFrameBytes<Message>);
  bytes.resize(wire::encode_frame(message, bytes));
  return {bytes.begin(), bytes.end()};
}

inline wire::Hello hello_of_boot(std::uint32_t boot_id) {
  return {.board = wire::text_of("pico"),
          .firmware = wire::text_of("1.2.3"),
          .unique_id = {0xe6, 0x60, 0x58, 0x38, 0x83, 0x1b, 0x2c, 0x21},
          .boot_id = boot_id,
          .tick_hz = 1'000'000,
          .rate_millihz = 50'000,
          .full_scale_counts = 4095,
          .reference_uv = 3'000'000,
          .sensor_count = 2};
}

inline std::string sample_frame(std::uint64_t seq, std::uint8_t flags = 0) {
  return frame_of(wire::SampleMessage{
      .seq = seq, .t_us = 20'000 * seq, .x_on = 1000, .x_off = 10, .flags = flags});
}

/// What one plugging in gives: the bytes up to its end, each piece in one read.
struct Life {
  std::vector<std::string> pieces{};
  std::string refusal{};             ///< instead: why the port cannot be opened
  std::uint8_t refused_command = 0;  ///< answered by invalid_rig
};

/// Answers commands by `Reply` as they come, and otherwise says its pieces, then is gone.
class ScriptedPort final : public BytePort {
 public:
  ScriptedPort(const Life& life, std::vector<std::uint8_t>& commands)
      : pieces_(life.pieces), refused_command_(life.refused_command), commands_(commands) {}

  tl::expected<Got, Error> read(std::span<std::uint8_t> bytes,
                                std::chrono::milliseconds /*patience*/) override {
    if (!replies_.empty()) {
      pieces_.insert(pieces_.begin() + static_cast<std::ptrdiff_t>(next_),
                     std::exchange(replies_, ""));
    }
    if (next_ == pieces_.size()) {
      return failure("script: gone");
    }
    const std::string& piece = pieces_[next_++];
    std::ranges::copy(piece, bytes.begin());
    return Got{piece.empty() ? Outcome::kNothingYet : Outcome::kBytes, piece.size()};
  }

  tl::expected<void, Error> write(std::span<const std::uint8_t> bytes) override {
    decoder_.push(bytes, [&](const wire::Frame& frame) {
      commands_.push_back(frame.type);
      constexpr std::array kAnswered = {wire::SetRate::kType, wire::SetEmitter::kType,
                                        wire::BeginRig::kType, wire::RigPart::kType,
                                        wire::EndRig::kType};
      if (std::ranges::find(kAnswered, frame.type) != kAnswered.end()) {
        replies_ += frame_of(wire::Reply{.command = frame.type,
                                         .token = frame.payload.front(),
                                         .result = frame.type == refused_command_
                                                       ? wire::Result::kInvalidRig
                                                       : wire::Result::kDone});
      }
    });
    return {};
  }
  [[nodiscard]] bool two_way() const override { return true; }
  [[nodiscard]] const std::string& name() const override { return name_; }

 private:
  std::vector<std::string> pieces_;
  std::uint8_t refused_command_;
  std::vector<std::uint8_t>& commands_;
  wire::Decoder decoder_;
  std::string replies_;
  std::size_t next_ = 0;
  std::string name_ = "script";
};

/// What came out of a board's lives.
struct Heard {
  std::vector<Sample> samples{};
  std::vector<std::string> said{};
  std::vector<std::string> events{};
  std::vector<std::string> complaints{};
  std::vector<std::uint8_t> commands{};
  std::vector<BoardAttempt> attempts{};
  std::string error{};
  RecordingHeader header{};
};

/// Listens until the last life is over.
inline Heard listen(std::vector<Life> lives, const BoardSettings& settings = {}) {
  Heard heard;
  std::size_t life = 0;
  bool over = false;
  const auto note = [&](const Source& source) {
    for (const RecordingEvent& event : source.events()) {
      heard.events.push_back(event.kind);
    }
  };
  auto source = BoardSource::open(
      [&](bool /*same_device*/) -> tl::expected<std::unique_ptr<BytePort>, Error> {
        over = life == lives.size();
        if (over) {
          return failure("script: over");
        }
        const Life& now = lives[life++];
        if (!now.refusal.empty()) {
          return failure(now.refusal);
        }
        return std::make_unique<ScriptedPort>(now, heard.commands);
      },
      settings,
      {.say = [&](const std::string& text) { heard.said.push_back(text); },
       .stop_requested = [&] { return over; },
       .attempted = [&](BoardAttempt attempt) { heard.attempts.push_back(attempt); }});
  if (!source) {
    heard.error = source.error().message;
    return heard;
  }
  heard.header = (*source)->header();
  Sample sample;
  while (!over) {
    const auto reading = (*source)->read(sample);
    note(**source);
    if (!reading) {
      heard.error = reading.error().message;
      break;
    }
    if (*reading == ReadResult::kEnded) {
      break;
    }
    if (*reading == ReadResult::kSample) {
      heard.samples.push_back(sample);
    }
  }
  heard.complaints = (*source)->complaints();
  return heard;
}

}  // namespace penduline::test
