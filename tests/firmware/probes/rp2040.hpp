// SPDX-License-Identifier: Apache-2.0
// The RP2040 registers that the probes use, and the set-up that most of them share.
#pragma once

#include <cstdint>

using Word = std::uint32_t;

inline volatile Word& at(Word address) {
  return *reinterpret_cast<volatile Word*>(address);
}
inline Word read(Word address) {
  return at(address);
}
inline void write(Word address, Word value) {
  at(address) = value;
}
inline void set_bits(Word address, Word bits) {
  at(address + 0x2000) = bits;
}
inline void clear_bits(Word address, Word bits) {
  at(address + 0x3000) = bits;
}

constexpr Word kClocks = 0x40008000, kResets = 0x4000c000, kPsm = 0x40010000, kIoBank0 = 0x40014000;
constexpr Word kPadsBank0 = 0x4001c000, kXosc = 0x40024000, kPllSys = 0x40028000,
               kPllUsb = 0x4002c000;
constexpr Word kUart0 = 0x40034000, kAdc = 0x4004c000, kTimer = 0x40054000, kWatchdog = 0x40058000;
constexpr Word kDma = 0x50000000, kSio = 0xd0000000;

constexpr Word kClkRefControl = kClocks + 0x30, kClkRefSelected = kClocks + 0x38;
constexpr Word kClkSysControl = kClocks + 0x3c, kClkSysSelected = kClocks + 0x44;
constexpr Word kClkPeriControl = kClocks + 0x48, kClkUsbControl = kClocks + 0x54,
               kClkAdcControl = kClocks + 0x60;
constexpr Word kWatchdogControl = kWatchdog, kWatchdogLoad = kWatchdog + 4,
               kWatchdogReason = kWatchdog + 8;
constexpr Word kWatchdogScratch0 = kWatchdog + 0x0c, kWatchdogTick = kWatchdog + 0x2c;
constexpr Word kTimerAlarm0 = kTimer + 0x10, kTimerRawLow = kTimer + 0x28,
               kTimerInterrupts = kTimer + 0x34;
constexpr Word kTimerEnables = kTimer + 0x38;
constexpr Word kAdcControl = kAdc, kAdcResult = kAdc + 4, kAdcFifoControl = kAdc + 8,
               kAdcFifo = kAdc + 0x0c;
constexpr Word kAdcDivider = kAdc + 0x10, kAdcEnables = kAdc + 0x18;
constexpr Word kUartData = kUart0, kUartFlags = kUart0 + 0x18, kUartMask = kUart0 + 0x38,
               kUartClear = kUart0 + 0x44;

constexpr Word kSysTickControl = 0xe000e010, kSysTickReload = 0xe000e014,
               kSysTickValue = 0xe000e018;
constexpr Word kNvicEnable = 0xe000e100, kNvicDisable = 0xe000e180, kNvicPend = 0xe000e200,
               kNvicUnpend = 0xe000e280;
constexpr Word kSystemReset = 0xe000ed0c;

constexpr Word kTimerReset = 1u << 21, kAdcReset = 1u << 0, kDmaReset = 1u << 2,
               kUartReset = 1u << 22;
constexpr Word kUsbReset = 1u << 24, kIoReset = 1u << 5, kPadsReset = 1u << 8,
               kPllsReset = 3u << 12;

inline void release(Word resets) {
  clear_bits(kResets, resets);
  while ((read(kResets + 8) & resets) != resets) {
  }
}

inline void start_pll(Word pll, Word feedback, Word divider1, Word divider2) {
  write(pll, 1);
  write(pll + 8, feedback);
  clear_bits(pll + 4, 1u | 1u << 5);
  while (!(read(pll) >> 31)) {
  }
  write(pll + 0xc, divider1 << 16 | divider2 << 12);
  clear_bits(pll + 4, 1u << 3);
}

inline void start_crystal() {
  write(kXosc + 0xc, 47);
  write(kXosc, 0xfabaa0);
  while (!(read(kXosc + 4) >> 31)) {
  }
}

/// 125 MHz from the crystal, 48 MHz for USB and ADC, and ticks of 1 us.
inline void start_clocks() {
  start_crystal();
  write(kClkRefControl, 2);
  while (!(read(kClkRefSelected) & 4)) {
  }
  release(kPllsReset);
  start_pll(kPllSys, 125, 6, 2);
  start_pll(kPllUsb, 100, 5, 5);
  write(kClkSysControl, 0);
  write(kClkSysControl, 1);
  while (!(read(kClkSysSelected) & 2)) {
  }
  write(kClkPeriControl, 1u << 11);
  write(kClkUsbControl, 1u << 11);
  write(kClkAdcControl, 1u << 11);
  write(kWatchdogTick, 12 | 1u << 9);
}

/// What every probe but the planted mistakes begins with.
inline void start_board() {
  release(kIoReset | kPadsReset);
  start_clocks();
  release(kTimerReset | kAdcReset | kDmaReset | kUartReset);
}

inline void choose_function(Word pin, Word function) {
  write(kPadsBank0 + 4 + 4 * pin, 1u << 6 | 1u << 4 | 1u << 1);
  write(kIoBank0 + 8 * pin + 4, function);
}

/// Digital input and output off, no pulls.
inline void choose_analog(Word pin) {
  write(kPadsBank0 + 4 + 4 * pin, 1u << 7);
  write(kIoBank0 + 8 * pin + 4, 31);
}

/// 115200 baud, 8N1, FIFOs on.
inline void start_uart() {
  write(kUart0 + 0x24, 67);
  write(kUart0 + 0x28, 52);
  write(kUart0 + 0x2c, 3u << 5 | 1u << 4);
  write(kUart0 + 0x30, 1u << 9 | 1u << 8 | 1u);
  choose_function(0, 2);
  choose_function(1, 2);
}

inline Word now_us() {
  return read(kTimerRawLow);
}
inline void enable_interrupt(Word number) {
  write(kNvicEnable, 1u << number);
}
inline void disable_interrupts() {
  asm volatile("cpsid i" ::: "memory");
}
inline void enable_interrupts() {
  asm volatile("cpsie i\nnop\nnop" ::: "memory");
}
inline void sleep() {
  asm volatile("wfi" ::: "memory");
}
