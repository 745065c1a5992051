// SPDX-License-Identifier: Apache-2.0
// Tests of the ring of frames: whole ones only, the oldest give way, each loss is counted.
#include "firmware/frame_ring.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace penduline::test {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// `size` bytes that count up from `first`.
Bytes frame(std::uint8_t first, std::size_t size) {
  Bytes bytes(size);
  std::iota(bytes.begin(), bytes.end(), first);
  return bytes;
}

template <std::size_t kBytes>
Bytes popped(FrameRing<kBytes>& ring) {
  std::array<std::uint8_t, 256> out{};
  const std::size_t size = ring.pop(out);
  return {out.begin(), out.begin() + static_cast<std::ptrdiff_t>(size)};
}

TEST_CASE("Frames come out whole and in order", "[frame_ring]") {
  FrameRing<64> ring;
  CHECK(ring.free_bytes() == 64);
  CHECK(popped(ring).empty());
  ring.push(frame(1, 5));
  ring.push(frame(50, 1));
  ring.push(frame(0, 20));
  CHECK_FALSE(ring.free_bytes() == 64);
  CHECK(popped(ring) == frame(1, 5));
  CHECK(popped(ring) == frame(50, 1));
  CHECK(popped(ring) == frame(0, 20));
  CHECK(ring.free_bytes() == 64);
  CHECK(ring.dropped() == 0);
}

TEST_CASE("A full ring drops its oldest frames, as many as the new one needs", "[frame_ring]") {
  FrameRing<64> ring;  // a frame of n bytes takes n + 1
  ring.push(frame(1, 15));
  ring.push(frame(2, 15));
  ring.push(frame(3, 15));
  ring.push(frame(4, 15));
  CHECK(ring.dropped() == 0);
  ring.push(frame(5, 1));
  CHECK(ring.dropped() == 1);
  ring.push(frame(6, 30));
  CHECK(ring.dropped() == 3);
  CHECK(popped(ring) == frame(4, 15));
  CHECK(popped(ring) == frame(5, 1));
  CHECK(popped(ring) == frame(6, 30));
  CHECK(ring.free_bytes() == 64);
}

TEST_CASE("A ring wraps at every offset without a byte out of place", "[frame_ring]") {
  for (std::size_t offset = 0; offset < 64; ++offset) {
    CAPTURE(offset);
    FrameRing<64> ring;
    for (std::size_t i = 0; i < offset; ++i) {
      ring.push(frame(7, 1));  // two bytes; an odd offset is made by the longer one below
      static_cast<void>(popped(ring));
    }
    if (offset % 2 == 1) {
      ring.push(frame(7, 2));
      static_cast<void>(popped(ring));
    }
    ring.push(frame(10, 29));
    ring.push(frame(90, 33));
    CHECK(popped(ring) == frame(10, 29));
    ring.push(frame(150, 29));
    ring.push(frame(200, 10));
    CHECK(ring.dropped() == 1);
    CHECK(popped(ring) == frame(150, 29));
    CHECK(popped(ring) == frame(200, 10));
    CHECK(ring.free_bytes() == 64);
  }
}

TEST_CASE("A frame that fills the ring is kept, a longer one or an empty one is a loss",
          "[frame_ring]") {
  FrameRing<64> small;
  small.push(frame(1, 63));
  CHECK(popped(small) == frame(1, 63));
  small.push(frame(2, 3));
  small.push(frame(1, 64));
  small.push({});
  CHECK(small.dropped() == 2);
  CHECK(popped(small) == frame(2, 3));

  FrameRing<512> large;  // a size is one byte
  large.push(frame(1, 255));
  large.push(frame(1, 256));
  CHECK(large.dropped() == 1);
  CHECK(popped(large) == frame(1, 255));
}

}  // namespace
}  // namespace penduline::test
