// SPDX-License-Identifier: Apache-2.0
// The rig in the board's store: a mark, its size, its CRC, its image.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "common/wire/bytes.hpp"
#include "common/wire/choices.hpp"
#include "common/wire/crc32.hpp"
#include "common/wire/rig_image.hpp"
#include "hal/concepts.hpp"

namespace penduline {

/// What stands in a store.
struct StoredRig {
  wire::StoreState state = wire::StoreState::kEmpty;
  std::optional<wire::BoardRig> rig;  ///< where the state is kValid
};

namespace rig_store {
inline constexpr std::uint32_t kMark = 0x31474952;  // "RIG1"
inline constexpr std::uint8_t kErased = 0xff;
inline constexpr std::size_t kHeadBytes =
    sizeof(kMark) + sizeof(std::uint16_t) + sizeof(std::uint32_t);

/// Whether nothing was ever written there.
[[nodiscard]] inline bool is_erased(std::span<const std::uint8_t> contents) {
  return contents.size() >= kHeadBytes &&
         std::ranges::all_of(contents.first(kHeadBytes),
                             [](std::uint8_t byte) { return byte == kErased; });
}

/// The rig, if that is what the contents are.
[[nodiscard]] inline std::optional<wire::BoardRig> rig_in(std::span<const std::uint8_t> contents) {
  if (contents.size() < kHeadBytes) {
    return std::nullopt;
  }
  wire::ByteReader reader(contents.first(kHeadBytes));
  const auto mark = reader.take<std::uint32_t>();
  const auto size = reader.take<std::uint16_t>();
  const auto crc = reader.take<std::uint32_t>();
  if (mark != kMark || size > contents.size() - kHeadBytes ||
      wire::crc32(contents.subspan(kHeadBytes, size)) != crc) {
    return std::nullopt;
  }
  return wire::decode_rig(contents.subspan(kHeadBytes, size));
}

}  // namespace rig_store

/// Reads the rig; whatever is not exactly one is damaged, whatever was erased is empty. A rig is
/// large for a board's stack: it is made where the caller has it.
[[nodiscard]] inline StoredRig read_rig(std::span<const std::uint8_t> contents) {
  StoredRig stored{
      .state = rig_store::is_erased(contents) ? wire::StoreState::kEmpty : wire::StoreState::kValid,
      .rig = rig_store::rig_in(contents)};
  if (stored.state == wire::StoreState::kValid && !stored.rig) {
    stored.state = wire::StoreState::kDamaged;
  }
  return stored;
}

/// Stores a rig's image; false where the store did not take it.
template <Store Memory>
[[nodiscard]] bool write_rig(Memory& store, std::span<const std::uint8_t> image) {
  std::array<std::uint8_t, rig_store::kHeadBytes + wire::kMaxRigImageBytes> block{};
  if (image.size() > wire::kMaxRigImageBytes) {
    return false;
  }
  wire::ByteWriter writer(block);
  writer.put(rig_store::kMark);
  writer.put(static_cast<std::uint16_t>(image.size()));
  writer.put(wire::crc32(image));
  std::ranges::copy(image, block.begin() + rig_store::kHeadBytes);
  return store.replace(
      std::span<const std::uint8_t>(block).first(rig_store::kHeadBytes + image.size()));
}

}  // namespace penduline
