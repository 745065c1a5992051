// SPDX-License-Identifier: Apache-2.0
// Watchdog and resets of the RP2040 (data sheet 2.12, 2.13, 4.7).
#pragma once

#include <cstdint>

#include "hal/concepts.hpp"
#include "hal/rp2040/boot_rom.hpp"
#include "hal/rp2040/registers.hpp"

namespace penduline::rp2040 {

class HardwareWatchdog {
 public:
  static constexpr std::uint32_t kTimeoutUs = 5'000'000;

  void start() {
    constexpr std::uint32_t kEnable = 1U << 30U;
    constexpr std::uint32_t kAllButOscillators = 0x1fffc;
    reg(watchdog::kPsmSelect) = kAllButOscillators;
    feed();
    set_bits(watchdog::kCtrl, kEnable);
  }
  void feed() { reg(watchdog::kLoad) = 2 * kTimeoutUs; }  // it counts two a microsecond (RP2040-E1)
};

static_assert(Watchdog<HardwareWatchdog>);

class ResetControl {
 public:
  [[nodiscard]] wire::ResetCause cause() {
    constexpr std::uint32_t kByTimer = 1U << 0U;
    constexpr std::uint32_t kByForce = 1U << 1U;
    constexpr std::uint32_t kChipReset = 0x40064008;  // 2.12.7
    constexpr std::uint32_t kByPin = 1U << 16U;
    const std::uint32_t reason = read(watchdog::kReason);
    if ((reason & kByTimer) != 0) {
      return wire::ResetCause::kWatchdog;
    }
    if ((reason & kByForce) != 0) {
      return wire::ResetCause::kSoftware;
    }
    return (read(kChipReset) & kByPin) != 0 ? wire::ResetCause::kExternal
                                            : wire::ResetCause::kPowerOn;
  }

  /// Through the watchdog, which resets what a processor's own reset leaves as it is.
  void restart() {
    constexpr std::uint32_t kTrigger = 1U << 31U;
    constexpr std::uint32_t kAllButOscillators = 0x1fffc;
    reg(watchdog::kPsmSelect) = kAllButOscillators;
    set_bits(watchdog::kCtrl, kTrigger);
    while (true) {
    }
  }

  void enter_bootloader() { rom::function<rom::UsbBoot>(rom::kUsbBoot)(0, 0); }
};

static_assert(Reboot<ResetControl>);

}  // namespace penduline::rp2040
