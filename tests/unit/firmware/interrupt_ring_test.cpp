// SPDX-License-Identifier: Apache-2.0
// Tests of the ring between an interrupt and the main loop.
#include "hal/interrupt_ring.hpp"

#include <catch2/catch.hpp>
#include <cstdint>
#include <thread>

namespace penduline::test {
namespace {

using Ring = InterruptRing<std::uint32_t, 4>;

bool put(Ring& ring, std::uint32_t value) {
  std::uint32_t* slot = ring.free_slot();
  if (slot == nullptr) {
    return false;
  }
  *slot = value;
  ring.put();
  return true;
}

TEST_CASE("A ring hands out in order what was put in", "[interrupt_ring]") {
  Ring ring;
  CHECK(ring.empty());
  CHECK(ring.full_slot() == nullptr);
  for (std::uint32_t value = 0; value < 11; ++value) {
    REQUIRE(put(ring, value));
    REQUIRE(put(ring, value + 100));
    CHECK(ring.size() == 2);
    CHECK(*ring.full_slot() == value);
    ring.drop();
    CHECK(*ring.full_slot() == value + 100);
    ring.drop();
    CHECK(ring.empty());
  }
}

TEST_CASE("All slots of a ring can be full, and then none is free", "[interrupt_ring]") {
  Ring ring;
  for (std::uint32_t value = 0; value < 4; ++value) {
    REQUIRE(put(ring, value));
  }
  CHECK(ring.size() == 4);
  CHECK_FALSE(put(ring, 4));
  CHECK(*ring.full_slot() == 0);
  ring.drop();
  CHECK(put(ring, 5));
}

TEST_CASE("A slot that was not put is not handed out", "[interrupt_ring]") {
  Ring ring;
  *ring.free_slot() = 7;
  CHECK(ring.full_slot() == nullptr);
  CHECK(ring.empty());
}

TEST_CASE("Two sides that run at once lose nothing and repeat nothing", "[interrupt_ring]") {
  constexpr std::uint32_t kItems = 50'000;
  Ring ring;
  std::thread filling([&] {
    for (std::uint32_t value = 0; value < kItems;) {
      value += put(ring, value) ? 1U : 0U;
      std::this_thread::yield();
    }
  });
  std::uint32_t expected = 0;
  bool in_order = true;
  while (expected < kItems) {
    if (const std::uint32_t* slot = ring.full_slot()) {
      in_order = in_order && *slot == expected++;
      ring.drop();
    }
    std::this_thread::yield();
  }
  filling.join();
  CHECK(in_order);
  CHECK(ring.empty());
}

}  // namespace
}  // namespace penduline::test
