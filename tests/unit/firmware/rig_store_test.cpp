// SPDX-License-Identifier: Apache-2.0
// Tests of the stored rig: it comes back as it was, or the store says what it is instead.
#include "firmware/rig_store.hpp"

#include <catch2/catch.hpp>
#include <cstdint>

#include "tests/unit/firmware/stored_rigs.hpp"

namespace penduline::test {
namespace {

using wire::StoreState;

TEST_CASE("An erased store is empty", "[rig_store]") {
  const MemoryStore store;
  const StoredRig stored = read_rig(store.contents());
  CHECK(stored.state == StoreState::kEmpty);
  CHECK_FALSE(stored.rig);
}

TEST_CASE("A rig that was written comes back as it was", "[rig_store]") {
  MemoryStore store;
  const Bytes image = image_of(two_sensor_rig());
  REQUIRE(write_rig(store, image));
  const StoredRig stored = read_rig(store.contents());
  CHECK(stored.state == StoreState::kValid);
  REQUIRE(stored.rig);
  CHECK(image_of(*stored.rig) == image);
}

TEST_CASE("Every single damaged bit is seen", "[rig_store]") {
  MemoryStore store;
  const Bytes image = image_of(two_sensor_rig());
  REQUIRE(write_rig(store, image));
  for (std::size_t at = 0; at < rig_store::kHeadBytes + image.size(); ++at) {
    for (unsigned bit = 0; bit < 8; ++bit) {
      CAPTURE(at, bit);
      MemoryStore damaged = store;
      damaged.bytes[at] ^= static_cast<std::uint8_t>(1U << bit);
      const StoredRig stored = read_rig(damaged.contents());
      CHECK(stored.state == StoreState::kDamaged);
      CHECK_FALSE(stored.rig);
    }
  }
}

TEST_CASE("A store that was cut while it was written is damaged, not empty", "[rig_store]") {
  MemoryStore store;
  const Bytes image = image_of(two_sensor_rig());
  REQUIRE(write_rig(store, image));
  for (std::size_t written = 1; written < rig_store::kHeadBytes + image.size(); ++written) {
    CAPTURE(written);
    MemoryStore cut;
    std::copy_n(store.bytes.begin(), written, cut.bytes.begin());
    CHECK(read_rig(cut.contents()).state == StoreState::kDamaged);
  }
}

TEST_CASE("What has the right CRC and is no rig is damaged", "[rig_store]") {
  MemoryStore store;
  REQUIRE(write_rig(store, bytes_of("01 02 03")));
  CHECK(read_rig(store.contents()).state == StoreState::kDamaged);
  REQUIRE(write_rig(store, {}));
  CHECK(read_rig(store.contents()).state == StoreState::kDamaged);
}

TEST_CASE("A store without room for a head, or for the image, is damaged", "[rig_store]") {
  MemoryStore store;
  const Bytes image = image_of(two_sensor_rig());
  REQUIRE(write_rig(store, image));
  const std::size_t whole = rig_store::kHeadBytes + image.size();
  CHECK(read_rig(store.contents().first(whole)).state == StoreState::kValid);
  CHECK(read_rig(store.contents().first(whole - 1)).state == StoreState::kDamaged);
  CHECK(read_rig(store.contents().first(rig_store::kHeadBytes - 1)).state == StoreState::kDamaged);
}

TEST_CASE("An image that is too long or a store that is worn out is not written", "[rig_store]") {
  MemoryStore store;
  CHECK_FALSE(write_rig(store, Bytes(wire::kMaxRigImageBytes + 1)));
  CHECK(read_rig(store.contents()).state == StoreState::kEmpty);
  store.worn_out = true;
  CHECK_FALSE(write_rig(store, image_of(two_sensor_rig())));
}

}  // namespace
}  // namespace penduline::test
