// SPDX-License-Identifier: Apache-2.0
// Watchdog and resets of the STM32F4 (RM0090 6.1, 7.3.21, 21).
#pragma once

#include <cstdint>

#include "hal/concepts.hpp"
#include "hal/stm32f4/registers.hpp"

namespace penduline::stm32f4 {

/// The independent watchdog: 5 s by its own oscillator, which is off by up to half.
class HardwareWatchdog {
 public:
  void start() {
    constexpr std::uint32_t kStart = 0xcccc;
    constexpr std::uint32_t kUnlock = 0x5555;
    constexpr std::uint32_t kDivideBy64 = 4;
    constexpr std::uint32_t kTicks = 2500;  // of 32 kHz / 64
    reg(iwdg::kKey) = kStart;
    reg(iwdg::kKey) = kUnlock;
    reg(iwdg::kPrescaler) = kDivideBy64;
    reg(iwdg::kReload) = kTicks - 1;
    feed();
  }
  void feed() { reg(iwdg::kKey) = 0xaaaa; }
};

static_assert(Watchdog<HardwareWatchdog>);

class ResetControl {
 public:
  /// Reads the cause and clears it for the next reset.
  void start();
  [[nodiscard]] wire::ResetCause cause() const { return cause_; }

  void restart();

  /// Restarts; `enter_requested_bootloader` does the rest, while the chip is as after a reset.
  void enter_bootloader();

  /// To be called first of all: begins the bootloader in the chip's ROM if the start before asked
  /// for it. It listens on USB (PA11, PA12) and USART1 (PA9, PA10) among others, not on the
  /// ST-Link's port: a Nucleo is flashed through its ST-Link, which needs no bootloader.
  static void enter_requested_bootloader();

 private:
  wire::ResetCause cause_ = wire::ResetCause::kUnknown;
};

static_assert(Reboot<ResetControl>);

}  // namespace penduline::stm32f4
