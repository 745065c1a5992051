// SPDX-License-Identifier: Apache-2.0
// Tests of a port: whole frames out whatever the link takes, and what damage to its stream costs.
#include "firmware/port.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdint>

#include "tests/unit/common/wire_examples.hpp"
#include "tests/unit/firmware/memory_link.hpp"

namespace penduline::test {
namespace {

using namespace wire;

constexpr std::uint64_t kNow = 5'000'000;

/// The tokens of all pings in a stream, in order.
std::vector<std::uint32_t> pings_in(const Bytes& stream) {
  std::vector<std::uint32_t> tokens;
  for (const KeptFrame& frame : frames_in(stream)) {
    tokens.push_back(read_message<Ping>(frame.payload).value().token);
  }
  return tokens;
}

/// Four frames; some of their numbers hold zeros, some none.
const std::vector<std::uint32_t> kTokens = {0x01020304, 0, 0xff00ff00, 0x7f7f7f7f};

Bytes stream_of_port() {
  MemoryLink link;
  Port port(link);
  for (const std::uint32_t token : kTokens) {
    port.send(Ping{.token = token});
  }
  port.pump(kNow);
  return link.sent;
}

TEST_CASE("A port sends a zero before each frame and one after it", "[port]") {
  MemoryLink link;
  Port port(link);
  port.send(Ping{.token = 7});
  port.send(Ping{.token = 7});
  port.pump(kNow);
  // The frame is docs/protocol.md's example.
  const Bytes frame = bytes_of("03 41 07 01 01 05 5d be 66 3e 00");
  CHECK(link.sent == joined({{0}, frame, {0}, frame}));
}

TEST_CASE("Any single bit flipped in a port's stream costs one frame at most", "[port]") {
  const Bytes stream = stream_of_port();
  REQUIRE(pings_in(stream) == kTokens);
  const std::size_t frame_bytes = stream.size() / kTokens.size();
  for (std::size_t at = 0; at < stream.size(); ++at) {
    for (unsigned bit = 0; bit < 8; ++bit) {
      CAPTURE(at, bit);
      Bytes damaged = stream;
      damaged[at] ^= static_cast<std::uint8_t>(1U << bit);
      damaged.push_back(0);  // what the next frame begins with
      std::vector<std::uint32_t> spared = kTokens;
      spared.erase(spared.begin() + static_cast<std::ptrdiff_t>(at / frame_bytes));
      CHECK(pings_in(damaged) == spared);
    }
  }
}

TEST_CASE("A frame goes out whole however few bytes the link takes", "[port]") {
  for (std::size_t most_at_once = 1; most_at_once <= 24; ++most_at_once) {
    CAPTURE(most_at_once);
    MemoryLink link{.most_at_once = most_at_once};
    Port port(link);
    for (const std::uint32_t token : kTokens) {
      port.send(Ping{.token = token});
    }
    port.pump(kNow);
    CHECK(link.sent == stream_of_port());
  }
}

TEST_CASE("A frame that has begun is finished although all after it give way", "[port]") {
  const std::size_t frame_bytes = stream_of_port().size() / kTokens.size();
  for (std::size_t begun = 1; begun < frame_bytes; ++begun) {
    CAPTURE(begun);
    MemoryLink link{.room = begun};
    Port port(link);
    port.send(Ping{.token = 1});
    port.pump(kNow);
    constexpr std::uint32_t kMany = 1000;
    for (std::uint32_t token = 2; token <= kMany; ++token) {
      port.send(Ping{.token = token});
      port.pump(kNow);
    }
    link.room = MemoryLink::kEndless;
    port.pump(kNow);
    const std::vector<std::uint32_t> arrived = pings_in(link.sent);
    CHECK(arrived.front() == 1);
    CHECK(arrived.back() == kMany);
    CHECK(std::ranges::is_sorted(arrived));
    // The ones that gave way are the oldest but the first, and all of them are counted.
    CHECK(arrived[1] == port.dropped_frames() + 2);
    CHECK(arrived.size() + port.dropped_frames() == kMany);
  }
}

TEST_CASE("A port hands out what has come and counts what is damaged", "[port]") {
  MemoryLink link;
  Port port(link);
  Bytes damaged = frame_of(Ping{.token = 2});
  damaged[4] ^= 0x40U;
  link.to_read = joined({frame_of(Ping{.token = 1}), damaged, frame_of(Ping{.token = 3})});
  std::vector<std::uint32_t> tokens;
  port.receive(kNow, [&](const Frame& frame) {
    tokens.push_back(read_message<Ping>(frame.payload).value().token);
  });
  CHECK(tokens == std::vector<std::uint32_t>{1, 3});
  CHECK(port.bad_frames() == 1);
}

TEST_CASE("A flood waits where there is no room for its answers", "[port]") {
  MemoryLink link;
  Port port(link);
  port.send(Ping{});
  port.pump(kNow);
  link.room = 0;
  while (port.dropped_frames() == 0) {
    port.send(Hello{});
  }
  link.to_read.assign(100, 0);
  port.receive(kNow, [](const Frame&) {});
  CHECK(link.to_read.size() == 100);
  link.room = MemoryLink::kEndless;
  port.pump(kNow);
  port.receive(kNow, [](const Frame&) {});
  CHECK(link.to_read.empty());
}

TEST_CASE("A host that has not read for a tenth of a second is heard all the same", "[port]") {
  MemoryLink link;
  Port port(link);
  port.send(Ping{});
  port.pump(kNow);
  link.room = 0;
  while (port.dropped_frames() == 0) {
    port.send(Hello{});
  }
  link.to_read.assign(100, 0);
  port.receive(kNow + 100'001, [](const Frame&) {});
  CHECK(link.to_read.empty());
}

}  // namespace
}  // namespace penduline::test
