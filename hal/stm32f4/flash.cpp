// SPDX-License-Identifier: Apache-2.0
// Erasing and programming the flash, from RAM: the program itself stands in it (RM0090 3.6).
#include "hal/stm32f4/flash.hpp"

#include <algorithm>
#include <cstddef>

#include "hal/cortex_m/interrupt_lock.hpp"
#include "hal/stm32f4/clocks.hpp"
#include "hal/stm32f4/registers.hpp"

// Code that runs while the flash cannot be read; the linker script puts it into RAM.
#define PENDULINE_IN_RAM __attribute__((section(".ram_code"), noinline, long_call))

namespace penduline::stm32f4 {
namespace {

constexpr std::uint32_t kStoreSector = 3;
constexpr std::uint32_t kStoreAddress = 0x0800c000;
constexpr std::uint32_t kStoreBytes = 16 * 1024;
constexpr std::uint8_t kErased = 0xff;

// Bits of the control register (3.9.7).
constexpr std::uint32_t kProgram = 1U << 0U;
constexpr std::uint32_t kEraseStore = (1U << 1U) | (kStoreSector << 3U);
constexpr std::uint32_t kWordsAtOnce = 2U << 8U;  // needs 2.7 V
constexpr std::uint32_t kStart = 1U << 16U;
constexpr std::uint32_t kLocked = 1U << 31U;

/// Waits for the flash, which the CPU could not do by fetching code from it, and keeps the clock
/// going. 16 KiB are erased in half a second at most; the bound is some four.
PENDULINE_IN_RAM bool wait_while_busy(Timer& timer) {
  constexpr std::uint32_t kBusy = 1U << 16U;
  constexpr std::uint32_t kErrors = 0xf2;
  for (std::uint32_t looks = 0; looks < 30'000'000; ++looks) {
    timer.follow();
    const std::uint32_t status = read(flash::kStatus);
    if ((status & kBusy) == 0) {
      return (status & kErrors) == 0;
    }
  }
  return false;
}

PENDULINE_IN_RAM bool erase_store(Timer& timer) {
  reg(flash::kCtrl) = kEraseStore | kWordsAtOnce;
  reg(flash::kCtrl) = kEraseStore | kWordsAtOnce | kStart;
  asm volatile("dsb" ::: "memory");
  return wait_while_busy(timer);
}

PENDULINE_IN_RAM bool program_word(Timer& timer, std::uint32_t address, std::uint32_t word) {
  reg(flash::kCtrl) = kProgram | kWordsAtOnce;
  reg(address) = word;
  asm volatile("dsb" ::: "memory");
  return wait_while_busy(timer);
}

/// False where the flash does not let itself be written.
bool unlock() {
  constexpr std::uint32_t kClearAll = 0xf3;
  reg(flash::kKey) = 0x45670123;
  reg(flash::kKey) = 0xcdef89ab;
  reg(flash::kStatus) = kClearAll;
  return (read(flash::kCtrl) & kLocked) == 0;
}

/// The caches still have what stood in the flash before (3.5.2).
void forget_cached() {
  constexpr std::uint32_t kCaches = 3U << 9U;
  constexpr std::uint32_t kForget = 3U << 11U;
  const std::uint32_t on = read(flash::kAccess) & kCaches;
  clear_bits(flash::kAccess, kCaches);
  set_bits(flash::kAccess, kForget);
  clear_bits(flash::kAccess, kForget);
  set_bits(flash::kAccess, on);
}

[[nodiscard]] std::uint32_t word_at(std::span<const std::uint8_t> block, std::size_t at) {
  std::uint32_t word = 0;
  for (std::size_t i = 0; i < sizeof(word); ++i) {
    const std::uint32_t byte = at + i < block.size() ? block[at + i] : kErased;
    word |= byte << (8 * i);
  }
  return word;
}

}  // namespace

std::span<const std::uint8_t> FlashStore::contents() const {
  return {reinterpret_cast<const std::uint8_t*>(kStoreAddress), kStoreBytes};  // NOLINT
}

bool FlashStore::replace(std::span<const std::uint8_t> block) {
  if (block.size() > kStoreBytes || !unlock()) {
    return false;
  }
  bool taken = false;
  {
    const cortex_m::InterruptLock lock;
    taken = erase_store(timer_);
  }
  for (std::uint32_t at = 0; taken && at < block.size(); at += sizeof(std::uint32_t)) {
    const cortex_m::InterruptLock lock;
    taken = program_word(timer_, kStoreAddress + at, word_at(block, at));
  }
  reg(flash::kCtrl) = kLocked;
  forget_cached();
  timer_.resume();
  const auto is_erased = [](std::uint8_t byte) { return byte == kErased; };
  return taken && std::equal(block.begin(), block.end(), contents().begin()) &&
         std::ranges::all_of(contents().subspan(block.size()), is_erased);
}

std::array<std::uint8_t, kUniqueIdBytes> ChipId::unique_id() const {
  constexpr std::uint32_t kNumber = 0x1fff7a10;
  constexpr std::uint32_t kNumberBytes = 12;
  std::array<std::uint8_t, kUniqueIdBytes> id{};
  if (on_silicon()) {
    for (std::uint32_t i = 0; i < kNumberBytes; ++i) {
      const std::uint32_t word = read(kNumber + i / 4 * 4);
      id[i % id.size()] ^= static_cast<std::uint8_t>(word >> (8 * (i % 4)));
    }
  }
  return id;
}

}  // namespace penduline::stm32f4
