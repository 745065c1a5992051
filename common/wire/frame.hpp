// SPDX-License-Identifier: Apache-2.0
// Frames: COBS(type byte, payload, CRC-32 of both), ended by a zero.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "common/wire/bytes.hpp"
#include "common/wire/cobs.hpp"
#include "common/wire/crc32.hpp"
#include "common/wire/messages.hpp"

namespace penduline::wire {

inline constexpr std::size_t kTypeBytes = 1;
inline constexpr std::size_t kCrcBytes = 4;
/// Type, payload and CRC together: what one COBS block holds, so that a frame costs two bytes more.
inline constexpr std::size_t kMaxBodyBytes = 254;
/// The payload of any version to come.
inline constexpr std::size_t kMaxPayloadBytes = kMaxBodyBytes - kTypeBytes - kCrcBytes;
/// A frame without its zero, of any version to come.
inline constexpr std::size_t kMaxEncodedBytes = cobs_bound(kMaxBodyBytes);
/// A whole frame, of any message of any version to come.
inline constexpr std::size_t kMaxFrameBytes = kMaxEncodedBytes + 1;

static_assert(kLongestPayloadBytes <= kMaxPayloadBytes);

/// A whole frame of one kind of message.
template <Message Kind>
inline constexpr std::size_t kFrameBytes = cobs_bound(kTypeBytes + kPayloadBytes<Kind> +
                                                      kCrcBytes) +
                                           1;

/// Writes the message as a frame with its zero. Returns the bytes written, `kFrameBytes<Kind>`; 0
/// where `out` is too small.
template <Message Kind>
[[nodiscard]] constexpr std::size_t encode_frame(const Kind& message, std::span<std::uint8_t> out) {
  std::array<std::uint8_t, kTypeBytes + kPayloadBytes<Kind> + kCrcBytes> body{};
  ByteWriter writer(body);
  writer.put(Kind::kType);
  write_fields(message, writer);
  writer.put(crc32(std::span(body).first(writer.size())));
  if (out.size() < kFrameBytes<Kind>) {
    return 0;
  }
  const std::size_t size = cobs_encode(body, out);
  out[size] = 0;
  return size + 1;
}

/// A frame that arrived whole. A type that the reader does not know is to be skipped.
struct Frame {
  std::uint8_t type = 0;
  std::span<const std::uint8_t> payload;  ///< for `read_message`
};

/// Opens a frame that came without its zero, in place: the payload stays in `encoded`. Nothing
/// where it is damaged.
[[nodiscard]] constexpr std::optional<Frame> open_frame(std::span<std::uint8_t> encoded) {
  const auto size = cobs_decode(encoded, encoded);
  if (!size || *size < kTypeBytes + kCrcBytes) {
    return std::nullopt;
  }
  const auto covered = encoded.first(*size - kCrcBytes);
  ByteReader reader(encoded.subspan(covered.size()));
  if (reader.take<std::uint32_t>() != crc32(covered)) {
    return std::nullopt;
  }
  return Frame{.type = covered.front(), .payload = covered.subspan(kTypeBytes)};
}

}  // namespace penduline::wire
