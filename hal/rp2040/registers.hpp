// SPDX-License-Identifier: Apache-2.0
// The RP2040's registers, those that are used (RP2040 data sheet; section numbers stand beside
// them).
#pragma once

#include <cstdint>

#include "hal/cortex_m/registers.hpp"

namespace penduline::rp2040 {

using cortex_m::read;
using cortex_m::reg;
using cortex_m::wait_for;

// Atomic access by alias (2.1.2); not for SIO, the Cortex-M0+ itself and the USB controller's
// memory.
inline void set_bits(std::uint32_t address, std::uint32_t bits) {
  reg(address + 0x2000) = bits;
}
inline void clear_bits(std::uint32_t address, std::uint32_t bits) {
  reg(address + 0x3000) = bits;
}

namespace resets {  // 2.14
inline constexpr std::uint32_t kReset = 0x4000c000;
inline constexpr std::uint32_t kDone = 0x4000c008;
inline constexpr std::uint32_t kAdc = 1U << 0U;
inline constexpr std::uint32_t kDma = 1U << 2U;
inline constexpr std::uint32_t kIoBank0 = 1U << 5U;
inline constexpr std::uint32_t kPadsBank0 = 1U << 8U;
inline constexpr std::uint32_t kPllSys = 1U << 12U;
inline constexpr std::uint32_t kPllUsb = 1U << 13U;
inline constexpr std::uint32_t kTimer = 1U << 21U;
inline constexpr std::uint32_t kUart0 = 1U << 22U;
inline constexpr std::uint32_t kUsb = 1U << 24U;
}  // namespace resets

namespace clocks {  // 2.15
inline constexpr std::uint32_t kRefCtrl = 0x40008030;
inline constexpr std::uint32_t kRefSelected = 0x40008038;
inline constexpr std::uint32_t kSysCtrl = 0x4000803c;
inline constexpr std::uint32_t kSysSelected = 0x40008044;
inline constexpr std::uint32_t kPeriCtrl = 0x40008048;
inline constexpr std::uint32_t kUsbCtrl = 0x40008054;
inline constexpr std::uint32_t kAdcCtrl = 0x40008060;
inline constexpr std::uint32_t kEnable = 1U << 11U;
}  // namespace clocks

namespace xosc {  // 2.16
inline constexpr std::uint32_t kCtrl = 0x40024000;
inline constexpr std::uint32_t kStatus = 0x40024004;
inline constexpr std::uint32_t kStartup = 0x4002400c;
}  // namespace xosc

namespace pll {  // 2.18
inline constexpr std::uint32_t kSys = 0x40028000;
inline constexpr std::uint32_t kUsb = 0x4002c000;
inline constexpr std::uint32_t kCs = 0x0;
inline constexpr std::uint32_t kPower = 0x4;
inline constexpr std::uint32_t kFeedback = 0x8;
inline constexpr std::uint32_t kPostDividers = 0xc;
}  // namespace pll

namespace watchdog {  // 4.7
inline constexpr std::uint32_t kCtrl = 0x40058000;
inline constexpr std::uint32_t kLoad = 0x40058004;
inline constexpr std::uint32_t kReason = 0x40058008;
inline constexpr std::uint32_t kScratch0 = 0x4005800c;
inline constexpr std::uint32_t kTick = 0x4005802c;
inline constexpr std::uint32_t kPsmSelect = 0x40010008;  // 2.13: what the watchdog resets
}  // namespace watchdog

namespace gpio {                                        // 2.19
inline constexpr std::uint32_t kFunction = 0x40014004;  // + 8 n
inline constexpr std::uint32_t kPad = 0x4001c004;       // + 4 n
inline constexpr std::uint32_t kOutSet = 0xd0000014;    // SIO, 2.3.1
inline constexpr std::uint32_t kOutClear = 0xd0000018;
inline constexpr std::uint32_t kEnableSet = 0xd0000024;
inline constexpr std::uint32_t kFlashSelect = 0x4001800c;  // 2.19.6.2, of the flash's chip select
inline constexpr std::uint32_t kFunctionUart = 2;
inline constexpr std::uint32_t kFunctionSio = 5;
inline constexpr std::uint32_t kFunctionNone = 31;
}  // namespace gpio

namespace adc {  // 4.9
inline constexpr std::uint32_t kCs = 0x4004c000;
inline constexpr std::uint32_t kResult = 0x4004c004;
inline constexpr std::uint32_t kFifoCs = 0x4004c008;
inline constexpr std::uint32_t kFifo = 0x4004c00c;
inline constexpr std::uint32_t kEnable = 1U << 0U;
inline constexpr std::uint32_t kTemperatureOn = 1U << 1U;
inline constexpr std::uint32_t kStartOne = 1U << 2U;
inline constexpr std::uint32_t kStartMany = 1U << 3U;
inline constexpr std::uint32_t kReady = 1U << 8U;
}  // namespace adc

namespace timer {  // 4.6
inline constexpr std::uint32_t kAlarm0 = 0x40054010;
inline constexpr std::uint32_t kAlarm1 = 0x40054014;
inline constexpr std::uint32_t kAlarm2 = 0x40054018;
inline constexpr std::uint32_t kRawHigh = 0x40054024;
inline constexpr std::uint32_t kRawLow = 0x40054028;
inline constexpr std::uint32_t kInterrupts = 0x40054034;
inline constexpr std::uint32_t kInterruptEnable = 0x40054038;
}  // namespace timer

namespace dma {  // 2.5, channel 0
inline constexpr std::uint32_t kReadAddress = 0x50000000;
inline constexpr std::uint32_t kWriteAddress = 0x50000004;
inline constexpr std::uint32_t kCount = 0x50000008;
inline constexpr std::uint32_t kCtrlTrigger = 0x5000000c;
inline constexpr std::uint32_t kInterruptEnable0 = 0x50000404;
inline constexpr std::uint32_t kInterruptStatus0 = 0x5000040c;
inline constexpr std::uint32_t kDreqAdc = 36;
}  // namespace dma

namespace uart {  // 4.2, UART0
inline constexpr std::uint32_t kData = 0x40034000;
inline constexpr std::uint32_t kFlags = 0x40034018;
inline constexpr std::uint32_t kBaudInteger = 0x40034024;
inline constexpr std::uint32_t kBaudFraction = 0x40034028;
inline constexpr std::uint32_t kLineCtrl = 0x4003402c;
inline constexpr std::uint32_t kCtrl = 0x40034030;
inline constexpr std::uint32_t kInterruptMask = 0x40034038;
inline constexpr std::uint32_t kInterruptClear = 0x40034044;
}  // namespace uart

namespace ssi {  // 4.10.13, the flash's interface
inline constexpr std::uint32_t kStatus = 0x18000028;
inline constexpr std::uint32_t kData = 0x18000060;
}  // namespace ssi

namespace cortex {  // 2.4.8
inline constexpr std::uint32_t kNvicEnable = 0xe000e100;
inline constexpr std::uint32_t kNvicDisable = 0xe000e180;
inline constexpr std::uint32_t kNvicClearPending = 0xe000e280;
inline constexpr std::uint32_t kNvicPriority = 0xe000e400;
inline constexpr std::uint32_t kVectorTable = 0xe000ed08;
inline constexpr std::uint32_t kReset = 0xe000ed0c;
inline constexpr std::uint32_t kResetRequest = 0x05fa0004;
}  // namespace cortex

/// Interrupt numbers (2.3.2).
enum class Interrupt : std::uint32_t {
  kTimer0 = 0,
  kTimer1 = 1,
  kTimer2 = 2,
  kUsb = 5,
  kDma0 = 11,
  kUart0 = 20
};

/// Sampling goes before all else; links may wait for it.
enum class Priority : std::uint32_t { kSampling = 0x00, kLink = 0xc0 };

inline void enable_interrupt(Interrupt interrupt) {
  reg(cortex::kNvicEnable) = 1U << static_cast<std::uint32_t>(interrupt);
}
inline void disable_interrupt(Interrupt interrupt) {
  reg(cortex::kNvicDisable) = 1U << static_cast<std::uint32_t>(interrupt);
  asm volatile("dsb\nisb" ::: "memory");
}
inline void start_interrupt(Interrupt interrupt, Priority priority) {
  const auto number = static_cast<std::uint32_t>(interrupt);
  const std::uint32_t shift = 8 * (number % 4);
  volatile std::uint32_t& word = reg(cortex::kNvicPriority + 4 * (number / 4));
  word = (word & ~(0xffU << shift)) | (static_cast<std::uint32_t>(priority) << shift);
  reg(cortex::kNvicClearPending) = 1U << number;
  enable_interrupt(interrupt);
}

/// Takes a peripheral out of reset, from a known state.
[[nodiscard]] inline bool restart_peripheral(std::uint32_t bit) {
  set_bits(resets::kReset, bit);
  clear_bits(resets::kReset, bit);
  return wait_for(resets::kDone, bit);
}

}  // namespace penduline::rp2040
