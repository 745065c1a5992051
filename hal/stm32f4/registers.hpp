// SPDX-License-Identifier: Apache-2.0
// The STM32F405's and F446's registers, those that are used: both chips have them at the same
// addresses (reference manuals RM0090 and RM0390; sections of RM0090 stand beside them).
#pragma once

#include <cstdint>

#include "hal/cortex_m/registers.hpp"

namespace penduline::stm32f4 {

using cortex_m::read;
using cortex_m::reg;
using cortex_m::wait_for;

inline void set_bits(std::uint32_t address, std::uint32_t bits) {
  reg(address) = reg(address) | bits;
}
inline void clear_bits(std::uint32_t address, std::uint32_t bits) {
  reg(address) = reg(address) & ~bits;
}

/// Replaces the bits of a mask.
inline void write_field(std::uint32_t address, std::uint32_t mask, std::uint32_t bits) {
  reg(address) = (reg(address) & ~mask) | bits;
}

namespace rcc {  // 7.3
inline constexpr std::uint32_t kCtrl = 0x40023800;
inline constexpr std::uint32_t kPllConfig = 0x40023804;
inline constexpr std::uint32_t kConfig = 0x40023808;
inline constexpr std::uint32_t kAhb1Enable = 0x40023830;
inline constexpr std::uint32_t kApb1Enable = 0x40023840;
inline constexpr std::uint32_t kApb2Enable = 0x40023844;
inline constexpr std::uint32_t kCtrlStatus = 0x40023874;
inline constexpr std::uint32_t kInternalReady = 1U << 1U;  ///< in kCtrl
inline constexpr std::uint32_t kGpioA = 1U << 0U;          ///< in kAhb1Enable
inline constexpr std::uint32_t kUsart2 = 1U << 17U;        ///< in kApb1Enable
inline constexpr std::uint32_t kAdc1 = 1U << 8U;           ///< in kApb2Enable
}  // namespace rcc

namespace flash {  // 3.9
inline constexpr std::uint32_t kAccess = 0x40023c00;
inline constexpr std::uint32_t kKey = 0x40023c04;
inline constexpr std::uint32_t kStatus = 0x40023c0c;
inline constexpr std::uint32_t kCtrl = 0x40023c10;
}  // namespace flash

namespace gpio_a {  // 8.4
inline constexpr std::uint32_t kMode = 0x40020000;
inline constexpr std::uint32_t kPulls = 0x4002000c;
inline constexpr std::uint32_t kSetReset = 0x40020018;
inline constexpr std::uint32_t kFunctionLow = 0x40020020;  ///< of the pins 0 to 7
}  // namespace gpio_a

namespace adc {  // 13.13
inline constexpr std::uint32_t kCtrl1 = 0x40012004;
inline constexpr std::uint32_t kCtrl2 = 0x40012008;
inline constexpr std::uint32_t kSampleTimeLow = 0x40012010;  ///< of the channels 0 to 9
inline constexpr std::uint32_t kInjectedSequence = 0x40012038;
inline constexpr std::uint32_t kInjected1 = 0x4001203c;
inline constexpr std::uint32_t kInjected2 = 0x40012040;
inline constexpr std::uint32_t kCommonCtrl = 0x40012304;
}  // namespace adc

namespace usart2 {  // 30.6
inline constexpr std::uint32_t kStatus = 0x40004400;
inline constexpr std::uint32_t kData = 0x40004404;
inline constexpr std::uint32_t kBaud = 0x40004408;
inline constexpr std::uint32_t kCtrl1 = 0x4000440c;
}  // namespace usart2

namespace iwdg {  // 21.4
inline constexpr std::uint32_t kKey = 0x40003000;
inline constexpr std::uint32_t kPrescaler = 0x40003004;
inline constexpr std::uint32_t kReload = 0x40003008;
}  // namespace iwdg

namespace cortex {  // ARMv7-M B3.2 to B3.4
inline constexpr std::uint32_t kSysTickCtrl = 0xe000e010;
inline constexpr std::uint32_t kSysTickReload = 0xe000e014;
inline constexpr std::uint32_t kSysTickValue = 0xe000e018;
inline constexpr std::uint32_t kNvicEnable = 0xe000e100;
inline constexpr std::uint32_t kNvicDisable = 0xe000e180;
inline constexpr std::uint32_t kNvicPriority = 0xe000e400;
inline constexpr std::uint32_t kInterruptCtrl = 0xe000ed04;
inline constexpr std::uint32_t kReset = 0xe000ed0c;
inline constexpr std::uint32_t kSystemPriority3 = 0xe000ed20;
inline constexpr std::uint32_t kSysTickClear = 1U << 25U;    ///< in kInterruptCtrl
inline constexpr std::uint32_t kSysTickPending = 1U << 26U;  ///< in kInterruptCtrl
inline constexpr std::uint32_t kPendSvSet = 1U << 28U;       ///< in kInterruptCtrl
inline constexpr std::uint32_t kResetRequest = 0x05fa0004;
}  // namespace cortex

}  // namespace penduline::stm32f4
