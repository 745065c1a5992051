// SPDX-License-Identifier: Apache-2.0
// Shows the flash: unique id by direct commands, erase and program by the ROM's functions, and what
// stays.

#include "rp2040.hpp"

#ifndef FLASH_OFFSET
#define FLASH_OFFSET 0x1f0000
#endif
constexpr Word kSsi = 0x18000000, kSelect = 0x4001800c;

extern "C" {
volatile std::uint8_t unique_id[8];
volatile Word found, erased, programmed, programmed_again, boots;
std::uint8_t page[256];
__attribute__((section(".kept"))) volatile Word runs;
}

using Lookup = void* (*)(const std::uint16_t* table, Word code);
using Action = void (*)();
using Erase = void (*)(Word offset, Word bytes, Word block_bytes, std::uint8_t command);
using Program = void (*)(Word offset, const std::uint8_t* data, Word bytes);

static struct {
  Action connect, leave_xip, flush, enter_xip;
  Erase erase;
  Program program;
} rom;

template <typename Function>
static Function rom_function(char first, char second) {
  const auto lookup = reinterpret_cast<Lookup>(read(0x18) & 0xffff);
  const auto* table = reinterpret_cast<const std::uint16_t*>(read(0x14) & 0xffff);
  return reinterpret_cast<Function>(lookup(table, static_cast<Word>(second << 8 | first)));
}

/// Ends direct access; the probe needs no fast reads, so boot2 is not run again.
__attribute__((section(".ram"), noinline)) static void map_flash() {
#ifndef MISTAKE_NO_FLUSH
  rom.flush();
#endif
  rom.enter_xip();
}

__attribute__((section(".ram"), noinline)) static void unmap_flash() {
#ifndef MISTAKE_NO_UNMAP
#ifndef MISTAKE_NO_CONNECT
  rom.connect();
#endif
  rom.leave_xip();
#endif
}

__attribute__((section(".ram"), noinline)) static void read_unique_id() {
  disable_interrupts();
  rom.connect();
  rom.leave_xip();
  write(kSelect, 2u << 8);
  for (Word i = 0; i < 13; ++i) {
    write(kSsi + 0x60, i == 0 ? 0x4b : 0);
    while (!(read(kSsi + 0x28) & 8)) {
    }
    const Word byte = read(kSsi + 0x60);
    if (i >= 5)
      unique_id[i - 5] = static_cast<std::uint8_t>(byte);
  }
  write(kSelect, 0);
  rom.flush();
  rom.enter_xip();
  enable_interrupts();
}

#ifdef MISTAKE_FLASH_CODE
__attribute__((noinline))
#else
__attribute__((section(".ram"), noinline))
#endif
static void
change_flash(bool erase) {
  disable_interrupts();
  unmap_flash();
  if (erase)
    rom.erase(FLASH_OFFSET, 4096, 1u << 16, 0xd8);
  else
    rom.program(FLASH_OFFSET, page, 256);
  map_flash();
  enable_interrupts();
}

static volatile Word& stored() {
  return at(0x10000000 + (FLASH_OFFSET & ~0xfffu));
}

int main() {
  start_board();
  if (read(kWatchdogReason) == 0)
    runs = 0;
  runs = runs + 1;
  boots = runs;
  rom.connect = rom_function<Action>('I', 'F');
  rom.leave_xip = rom_function<Action>('E', 'X');
  rom.flush = rom_function<Action>('F', 'C');
  rom.enter_xip = rom_function<Action>('C', 'X');
  rom.erase = rom_function<Erase>('R', 'E');
  rom.program = rom_function<Program>('R', 'P');
  read_unique_id();
  found = stored();
  if (runs == 1) {
    change_flash(true);
    erased = stored();
    page[0] = 0xf0;
    change_flash(false);
    programmed = stored();
    page[0] = 0x3c;
    change_flash(false);
    programmed_again = stored();
    write(kPsm + 8, 0x1fffc);
    write(kWatchdogScratch0, 0xcafe);
    write(kWatchdogControl, 1u << 31);
  }
  if (runs == 2)
    rom_function<void (*)(Word, Word)>('U', 'B')(0, 0);
}
