// SPDX-License-Identifier: Apache-2.0
// A ring between an interrupt and the main loop: one puts in, the other takes out, nobody waits.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>

namespace penduline {

/// Slots that one side fills in place and the other empties. `Count` is a power of two; all of them
/// can be full. Loads and stores of the counters are all that it needs, so a Cortex-M0+ will do.
template <class Item, std::size_t Count>
class InterruptRing {
  static_assert(Count > 0 && (Count & (Count - 1)) == 0);

 public:
  /// The next free slot, for the side that fills; none while the ring is full.
  [[nodiscard]] Item* free_slot() {
    const std::uint32_t filled = filled_.load(std::memory_order_relaxed);
    return filled - emptied_.load(std::memory_order_acquire) == Count ? nullptr
                                                                      : &items_[filled % Count];
  }
  /// Hands the slot over.
  void put() {
    filled_.store(filled_.load(std::memory_order_relaxed) + 1, std::memory_order_release);
  }

  /// The oldest full slot, for the side that empties; none while the ring is empty.
  [[nodiscard]] Item* full_slot() {
    const std::uint32_t emptied = emptied_.load(std::memory_order_relaxed);
    return filled_.load(std::memory_order_acquire) == emptied ? nullptr : &items_[emptied % Count];
  }
  /// Gives the slot back.
  void drop() {
    emptied_.store(emptied_.load(std::memory_order_relaxed) + 1, std::memory_order_release);
  }

  [[nodiscard]] std::size_t size() const {
    return filled_.load(std::memory_order_acquire) - emptied_.load(std::memory_order_acquire);
  }
  [[nodiscard]] bool empty() const { return size() == 0; }

 private:
  std::array<Item, Count> items_{};
  std::atomic<std::uint32_t> filled_{0};
  std::atomic<std::uint32_t> emptied_{0};
};

/// Puts in as many of the bytes as there is room for; returns how many.
template <std::size_t Count>
std::size_t put_bytes(InterruptRing<std::uint8_t, Count>& ring,
                      std::span<const std::uint8_t> bytes) {
  std::size_t taken = 0;
  for (std::uint8_t* slot = nullptr; taken < bytes.size() && (slot = ring.free_slot()) != nullptr;
       ring.put()) {
    *slot = bytes[taken++];
  }
  return taken;
}

/// Takes out as many bytes as there are and `bytes` holds; returns how many.
template <std::size_t Count>
std::size_t take_bytes(InterruptRing<std::uint8_t, Count>& ring, std::span<std::uint8_t> bytes) {
  std::size_t given = 0;
  for (const std::uint8_t* slot = nullptr;
       given < bytes.size() && (slot = ring.full_slot()) != nullptr; ring.drop()) {
    bytes[given++] = *slot;
  }
  return given;
}

}  // namespace penduline
