// SPDX-License-Identifier: Apache-2.0
// Why the STM32F4 was reset, and how it is (RM0090 7.3.21; AN2606 for the bootloader).
#include "hal/stm32f4/reset.hpp"

#include "hal/stm32f4/clocks.hpp"

namespace penduline::stm32f4 {
namespace {

constexpr std::uint32_t kBootloaderAsked = 0xb0071ead;
[[gnu::section(".kept")]] volatile std::uint32_t kept_request;

}  // namespace

/// The pin is drawn low by every other reset too, so it comes last.
void ResetControl::start() {
  constexpr std::uint32_t kClear = 1U << 24U;
  constexpr std::uint32_t kBrownOut = 1U << 25U;
  constexpr std::uint32_t kPin = 1U << 26U;
  constexpr std::uint32_t kPowerOn = 1U << 27U;
  constexpr std::uint32_t kSoftware = 1U << 28U;
  constexpr std::uint32_t kWatchdogs = 3U << 29U;
  const std::uint32_t status = read(rcc::kCtrlStatus);
  set_bits(rcc::kCtrlStatus, kClear);
  if ((status & kWatchdogs) != 0) {
    cause_ = wire::ResetCause::kWatchdog;
  } else if ((status & kSoftware) != 0) {
    cause_ = wire::ResetCause::kSoftware;
  } else if ((status & (kPowerOn | kBrownOut)) != 0) {
    cause_ = wire::ResetCause::kPowerOn;
  } else if ((status & kPin) != 0) {
    cause_ = wire::ResetCause::kExternal;
  }
}

void ResetControl::restart() {
  asm volatile("dsb" ::: "memory");
  reg(cortex::kReset) = cortex::kResetRequest;
  asm volatile("dsb" ::: "memory");
  while (true) {
  }
}

void ResetControl::enter_bootloader() {
  kept_request = kBootloaderAsked;
  restart();
}

void ResetControl::enter_requested_bootloader() {
  constexpr std::uint32_t kRom = 0x1fff0000;
  if (kept_request != kBootloaderAsked) {
    return;
  }
  kept_request = 0;
  if (on_silicon()) {
    asm volatile(
        "msr msp, %0\n"
        "bx %1\n" ::"r"(read(kRom)),
        "r"(read(kRom + 4))
        : "memory");
    __builtin_unreachable();
  }
}

}  // namespace penduline::stm32f4
