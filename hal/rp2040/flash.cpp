// SPDX-License-Identifier: Apache-2.0
// Writing and asking the flash: from RAM, for the program itself stands in it (data
// sheet 2.8.3.1.3).
#include "hal/rp2040/flash.hpp"

#include <algorithm>
#include <cstddef>

#include "hal/cortex_m/interrupt_lock.hpp"
#include "hal/rp2040/boot_rom.hpp"
#include "hal/rp2040/registers.hpp"

// Code that runs while the flash cannot be read; the linker script puts it into RAM.
#define PENDULINE_IN_RAM __attribute__((section(".ram_code"), noinline))

namespace penduline::rp2040 {
namespace {

constexpr std::uint32_t kFlashBytes = 2U * 1024 * 1024;
constexpr std::uint32_t kSectorBytes = 4096;
constexpr std::uint32_t kPageBytes = 256;
constexpr std::uint32_t kStoreOffset = kFlashBytes - kSectorBytes;
constexpr std::uint32_t kFlashAddress = 0x10000000;

using Page = std::array<std::uint8_t, kPageBytes>;

/// What the ROM offers for the flash, looked up while the flash can still be read.
struct FlashFunctions {
  rom::Action connect = rom::function<rom::Action>(rom::kConnectFlash);
  rom::Action exit_xip = rom::function<rom::Action>(rom::kExitXip);
  rom::RangeErase erase = rom::function<rom::RangeErase>(rom::kEraseRange);
  rom::RangeProgram program = rom::function<rom::RangeProgram>(rom::kProgramRange);
  rom::Action flush_cache = rom::function<rom::Action>(rom::kFlushCache);
  rom::Action enter_xip = rom::function<rom::Action>(rom::kEnterXip);
};

PENDULINE_IN_RAM void erase_sector(const FlashFunctions& flash) {
  constexpr std::uint32_t kBlockBytes = 65536;
  constexpr std::uint8_t kBlockErase = 0xd8;
  flash.connect();
  flash.exit_xip();
  flash.erase(kStoreOffset, kSectorBytes, kBlockBytes, kBlockErase);
  flash.flush_cache();
  flash.enter_xip();
}

PENDULINE_IN_RAM void program_page(const FlashFunctions& flash, std::uint32_t offset,
                                   const Page& page) {
  flash.connect();
  flash.exit_xip();
  flash.program(offset, page.data(), kPageBytes);
  flash.flush_cache();
  flash.enter_xip();
}

/// One byte out and one in through the flash's interface; false where it does not answer.
PENDULINE_IN_RAM bool exchange(std::uint8_t out, std::uint8_t& in) {
  constexpr std::uint32_t kReceived = 1U << 3U;
  reg(ssi::kData) = out;
  for (int looks = 0; looks < 1000; ++looks) {
    if ((read(ssi::kStatus) & kReceived) != 0) {
      in = static_cast<std::uint8_t>(read(ssi::kData));
      return true;
    }
  }
  return false;
}

PENDULINE_IN_RAM bool ask_unique_id(const FlashFunctions& flash,
                                    std::array<std::uint8_t, kUniqueIdBytes>& id) {
  constexpr std::uint8_t kReadUniqueId = 0x4b;
  constexpr std::size_t kDummyBytes = 4;
  constexpr std::uint32_t kSelectMask = 3U << 8U;
  constexpr std::uint32_t kSelectLow = 2U << 8U;
  constexpr std::uint32_t kSelectHigh = 3U << 8U;
  flash.connect();
  flash.exit_xip();
  volatile std::uint32_t& select = reg(gpio::kFlashSelect);
  select = (select & ~kSelectMask) | kSelectLow;
  std::uint8_t byte = 0;
  bool answered = exchange(kReadUniqueId, byte);
  for (std::size_t i = 0; answered && i < kDummyBytes + id.size(); ++i) {
    answered = exchange(0, byte);
    if (i >= kDummyBytes) {
      id[i - kDummyBytes] = byte;
    }
  }
  select = (select & ~kSelectMask) | kSelectHigh;
  select = select & ~kSelectMask;
  flash.flush_cache();
  flash.enter_xip();
  return answered;
}

}  // namespace

std::span<const std::uint8_t> FlashStore::contents() const {
  return {reinterpret_cast<const std::uint8_t*>(kFlashAddress + kStoreOffset),  // NOLINT
          kSectorBytes};
}

bool FlashStore::replace(std::span<const std::uint8_t> block) {
  if (block.size() > kSectorBytes) {
    return false;
  }
  const FlashFunctions flash;
  {
    const cortex_m::InterruptLock lock;
    erase_sector(flash);
  }
  for (std::uint32_t at = 0; at < block.size(); at += kPageBytes) {
    Page page;
    page.fill(0xff);
    const auto part = block.subspan(at, std::min<std::size_t>(kPageBytes, block.size() - at));
    std::copy(part.begin(), part.end(), page.begin());
    const cortex_m::InterruptLock lock;
    program_page(flash, kStoreOffset + at, page);
  }
  const auto rest = contents().subspan(block.size());
  return std::equal(block.begin(), block.end(), contents().begin()) &&
         std::ranges::all_of(rest, [](std::uint8_t byte) { return byte == 0xff; });
}

void FlashId::start() {
  const FlashFunctions flash;
  const cortex_m::InterruptLock lock;
  if (!ask_unique_id(flash, id_)) {
    id_.fill(0);
  }
}

}  // namespace penduline::rp2040
