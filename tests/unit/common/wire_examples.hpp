// SPDX-License-Identifier: Apache-2.0
// What the tests of the wire share: bytes from hexadecimal text, an example of every message.
#pragma once

#include <array>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <tuple>
#include <vector>

#include "common/wire/decoder.hpp"
#include "common/wire/frame.hpp"
#include "common/wire/messages.hpp"

namespace penduline::test {

using Bytes = std::vector<std::uint8_t>;

/// "01 ff 00", any blanks between two digits each.
[[nodiscard]] inline Bytes bytes_of(std::string_view hex) {
  Bytes bytes;
  for (std::size_t i = 0; i + 1 < hex.size(); i += 2) {
    while (hex[i] == ' ') {
      ++i;
    }
    std::uint8_t byte = 0;
    std::from_chars(hex.data() + i, hex.data() + i + 2, byte, 16);
    bytes.push_back(byte);
  }
  return bytes;
}

template <wire::Message Kind>
[[nodiscard]] Bytes frame_of(const Kind& message) {
  std::array<std::uint8_t, wire::kMaxFrameBytes> room{};
  const std::size_t size = wire::encode_frame(message, room);
  return {room.data(), room.data() + size};
}

/// A frame of any type and payload, as a newer peer may send one.
[[nodiscard]] inline Bytes frame_of(std::uint8_t type, const Bytes& payload) {
  Bytes body = {type};
  body.insert(body.end(), payload.begin(), payload.end());
  const std::uint32_t crc = wire::crc32(body);
  for (unsigned shift = 0; shift < 32; shift += 8) {
    body.push_back(static_cast<std::uint8_t>(crc >> shift));
  }
  Bytes frame(wire::cobs_bound(body.size()));
  frame.resize(wire::cobs_encode(body, frame));
  frame.push_back(0);
  return frame;
}

[[nodiscard]] inline Bytes joined(std::initializer_list<Bytes> parts) {
  Bytes all;
  for (const Bytes& part : parts) {
    all.insert(all.end(), part.begin(), part.end());
  }
  return all;
}

/// A frame that outlives the decoder's next byte.
struct KeptFrame {
  std::uint8_t type = 0;
  Bytes payload;

  bool operator==(const KeptFrame&) const = default;
};

/// All frames that the decoder finds.
[[nodiscard]] inline std::vector<KeptFrame> frames_in(wire::Decoder& decoder,
                                                      std::span<const std::uint8_t> bytes) {
  std::vector<KeptFrame> frames;
  decoder.push(bytes, [&](const wire::Frame& frame) {
    frames.push_back({frame.type, Bytes(frame.payload.begin(), frame.payload.end())});
  });
  return frames;
}

[[nodiscard]] inline std::vector<KeptFrame> frames_in(std::span<const std::uint8_t> bytes) {
  wire::Decoder decoder;
  return frames_in(decoder, bytes);
}

/// One message of every kind with numbers that differ, in the order of `AllMessages`.
[[nodiscard]] inline wire::AllMessages example_messages() {
  using namespace wire;
  return {Hello{.board = text_of("pico"),
                .firmware = text_of("0.1.0"),
                .unique_id = {0xE6, 0x60, 0x58, 0x38, 0x83, 0x20, 0xB1, 0x2D},
                .boot_id = 0xDEADBEEF,
                .tick_hz = 1'000'000,
                .rate_millihz = 20'000,
                .full_scale_counts = 65535,
                .reference_uv = 3'300'000,
                .sensor_count = 2,
                .emitter_mode = EmitterMode::kSwitched,
                .window_us = 2000,
                .conversions = 64},
          SampleMessage{.seq = 0x0102030405060708,
                        .t_us = 50'000,
                        .x_on = 23411,
                        .x_off = 102,
                        .y_on = 22876,
                        .y_off = 99,
                        .flags = 5},
          Status{.t_us = 123'456'789'012,
                 .samples = 2469,
                 .dropped_frames = 1,
                 .bad_frames = 2,
                 .overruns = 3,
                 .late_max_us = 17,
                 .load_permille = 250,
                 .temperature_cdeg = 2531,
                 .stack_free_bytes = 1024,
                 .reset_cause = ResetCause::kFault,
                 .resets = 7,
                 .fault_pc = 0x10000ABC,
                 .fault_line = 0,
                 .fault_file = text_of("sampler.cpp"),
                 .store = StoreState::kValid,
                 .rate_millihz = 20'000,
                 .emitter_mode = EmitterMode::kDark},
          AnglesMessage{.seq = 2469,
                        .t_us = -50'000,
                        .theta1_rad = 0.25F,
                        .theta2_rad = -0.5F,
                        .residual_m = 1e-5F,
                        .flags = 4096,
                        .omega1_rad_s = 1.5F,
                        .omega2_rad_s = -2.0F,
                        .sigma1_rad = 1e-3F,
                        .sigma2_rad = 2e-3F},
          Pong{.token = 0x89ABCDEF, .t_us = 5'000'000'000},
          Reply{.command = 0x44, .token = 9, .result = Result::kOutOfRange},
          Ping{.token = 0x89ABCDEF},
          AskHello{.token = 1},
          AskStatus{.token = 2},
          SetRate{.token = 3, .rate_millihz = 100'000},
          SetEmitter{.token = 4, .mode = EmitterMode::kLit},
          Identify{.token = 5, .seconds = 10},
          wire::Reboot{.token = 6, .target = RebootTarget::kBootloader},
          BeginRig{.token = 7, .size_bytes = 596, .crc = 0xCBF43926},
          RigPart{.token = 8, .offset = 48, .count = 3, .bytes = {0x01, 0x00, 0xFF}},
          EndRig{.token = 9},
          EraseRig{.token = 10}};
}

}  // namespace penduline::test
