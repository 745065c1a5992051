// SPDX-License-Identifier: Apache-2.0
// Tests of the decoder: each fault costs the frame that it hits, and the next one arrives.
#include "common/wire/decoder.hpp"

#include <catch2/catch.hpp>
#include <cstdint>

#include "tests/unit/common/wire_examples.hpp"

namespace penduline::test {
namespace {

using namespace wire;

const Bytes kBefore = frame_of(Ping{.token = 0x01020304});
const Bytes kHit = frame_of(std::get<SampleMessage>(example_messages()));
const Bytes kAfter = frame_of(SetRate{.token = 3, .rate_millihz = 100'000});

const KeptFrame kPing = frames_in(kBefore).at(0);
const KeptFrame kSample = frames_in(kHit).at(0);
const KeptFrame kSetRate = frames_in(kAfter).at(0);

using Frames = std::vector<KeptFrame>;

TEST_CASE("Frames come out in order, whatever the pieces they arrive in", "[wire][decoder]") {
  const Bytes stream = joined({kBefore, kHit, kAfter});
  for (std::size_t piece = 1; piece <= stream.size(); ++piece) {
    CAPTURE(piece);
    Decoder decoder;
    Frames frames;
    for (std::size_t at = 0; at < stream.size(); at += piece) {
      const std::span<const std::uint8_t> rest = std::span(stream).subspan(at);
      for (const KeptFrame& frame : frames_in(decoder, rest.first(std::min(piece, rest.size())))) {
        frames.push_back(frame);
      }
    }
    CHECK(frames == Frames{kPing, kSample, kSetRate});
    CHECK(decoder.bad_frames() == 0);
  }
}

TEST_CASE("A flipped bit costs its frame only", "[wire][decoder]") {
  // The zero at the end is left whole: it parts two frames.
  for (std::size_t at = 0; at + 1 < kHit.size(); ++at) {
    for (unsigned bit = 0; bit < 8; ++bit) {
      CAPTURE(at, bit);
      Bytes damaged = kHit;
      damaged[at] ^= static_cast<std::uint8_t>(1U << bit);
      Decoder decoder;
      CHECK(frames_in(decoder, joined({kBefore, damaged, kAfter})) == Frames{kPing, kSetRate});
      // Where the flip makes a zero, the frame falls in two.
      CHECK(decoder.bad_frames() == (damaged[at] == 0 && at > 0 ? 2 : 1));
    }
  }
}

TEST_CASE("A frame cut at any byte costs itself only", "[wire][decoder]") {
  for (std::size_t kept = 1; kept + 1 < kHit.size(); ++kept) {
    CAPTURE(kept);
    // The board starts anew, and begins with a zero.
    const Bytes head(kHit.begin(), kHit.begin() + static_cast<std::ptrdiff_t>(kept));
    Decoder decoder;
    CHECK(frames_in(decoder, joined({kBefore, head, {0}, kAfter})) == Frames{kPing, kSetRate});
    CHECK(decoder.bad_frames() == 1);
  }
}

TEST_CASE("A stream that begins in the middle of a frame costs that frame", "[wire][decoder]") {
  for (std::size_t lost = 1; lost + 1 < kHit.size(); ++lost) {
    CAPTURE(lost);
    const Bytes tail(kHit.begin() + static_cast<std::ptrdiff_t>(lost), kHit.end());
    Decoder decoder;
    CHECK(frames_in(decoder, joined({tail, kAfter})) == Frames{kSetRate});
    CHECK(decoder.bad_frames() == 1);
  }
}

TEST_CASE("A lost byte costs its frame only", "[wire][decoder]") {
  for (std::size_t at = 0; at + 1 < kHit.size(); ++at) {
    CAPTURE(at);
    Bytes damaged = kHit;
    damaged.erase(damaged.begin() + static_cast<std::ptrdiff_t>(at));
    Decoder decoder;
    CHECK(frames_in(decoder, joined({kBefore, damaged, kAfter})) == Frames{kPing, kSetRate});
    CHECK(decoder.bad_frames() == 1);
  }
}

TEST_CASE("A lost zero costs the two frames that it parts, and they count as one",
          "[wire][decoder]") {
  Bytes open = kHit;
  open.pop_back();
  Decoder decoder;
  CHECK(frames_in(decoder, joined({kBefore, open, kAfter, kBefore})) == Frames{kPing, kPing});
  CHECK(decoder.bad_frames() == 1);
}

TEST_CASE("Noise before the first zero is one bad frame at most", "[wire][decoder]") {
  for (const std::size_t length :
       std::initializer_list<std::size_t>{1, 2, 254, 255, 256, 257, 10'000}) {
    CAPTURE(length);
    Decoder decoder;
    CHECK(frames_in(decoder, joined({Bytes(length, 0x55), {0}, kAfter})) == Frames{kSetRate});
    CHECK(decoder.bad_frames() == 1);
  }
}

TEST_CASE("Zeros in a row are no frames and no faults", "[wire][decoder]") {
  Decoder decoder;
  CHECK(frames_in(decoder, joined({Bytes(5, 0), kBefore, Bytes(3, 0), kAfter})) ==
        Frames{kPing, kSetRate});
  CHECK(decoder.bad_frames() == 0);
}

TEST_CASE("The longest frame arrives, one byte more is a bad frame", "[wire][decoder]") {
  const Bytes longest = frame_of(0x7F, Bytes(kMaxPayloadBytes, 0x5A));
  const Bytes longer = frame_of(0x7F, Bytes(kMaxPayloadBytes + 1, 0x5A));
  REQUIRE(longest.size() == kMaxFrameBytes);
  Decoder decoder;
  CHECK(frames_in(decoder, joined({longest, longer, kAfter})) ==
        Frames{{0x7F, Bytes(kMaxPayloadBytes, 0x5A)}, kSetRate});
  CHECK(decoder.bad_frames() == 1);
}

TEST_CASE("A type that is not known is handed out, not counted", "[wire][decoder]") {
  Decoder decoder;
  CHECK(frames_in(decoder, frame_of(0xEE, bytes_of("01 02"))) == Frames{{0xEE, bytes_of("01 02")}});
  CHECK(decoder.bad_frames() == 0);
}

TEST_CASE("A payload may be empty", "[wire][decoder]") {
  CHECK(frames_in(frame_of(0xEE, {})) == Frames{{0xEE, {}}});
}

TEST_CASE("A body too short for a type and a CRC is a bad frame", "[wire][decoder]") {
  // The CRC of nothing is 0: four zeros would pass for it.
  for (const char* encoded : {"01 00", "01 01 00", "01 01 01 00", "01 01 01 01 00"}) {
    CAPTURE(encoded);
    Decoder decoder;
    CHECK(frames_in(decoder, bytes_of(encoded)).empty());
    CHECK(decoder.bad_frames() == 1);
  }
}

}  // namespace
}  // namespace penduline::test
