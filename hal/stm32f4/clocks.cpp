// SPDX-License-Identifier: Apache-2.0
// Starting the STM32F4's clocks (RM0090 7.2 and 7.3, 3.5.1 for the flash).
#include "hal/stm32f4/clocks.hpp"

namespace penduline::stm32f4 {
namespace {

constexpr Clocks kFromPll{168'000'000, 42'000'000, 84'000'000};
constexpr Clocks kFromInternal{16'000'000, 16'000'000, 16'000'000};

/// The ST-Link of a Nucleo gives 8 MHz on the oscillator's pin; its own start takes a moment.
bool start_external() {
  constexpr std::uint32_t kOn = 1U << 16U;
  constexpr std::uint32_t kReady = 1U << 17U;
  constexpr std::uint32_t kBypass = 1U << 18U;
  constexpr std::uint32_t kLooks = 200'000;  // some 100 ms at 16 MHz
  set_bits(rcc::kCtrl, kBypass);
  set_bits(rcc::kCtrl, kOn);
  if (wait_for(rcc::kCtrl, kReady, kLooks)) {
    return true;
  }
  clear_bits(rcc::kCtrl, kOn);
  return false;
}

/// 2 MHz in, times 168, divided by 2: 168 MHz, which both chips take without over-drive.
bool start_pll(bool from_external) {
  constexpr std::uint32_t kOn = 1U << 24U;
  constexpr std::uint32_t kLocked = 1U << 25U;
  constexpr std::uint32_t kTimes168 = 168U << 6U;
  constexpr std::uint32_t kDividedBy2 = 0U << 16U;
  constexpr std::uint32_t kUsbDividedBy7 = 7U << 24U;
  constexpr std::uint32_t kAsAfterReset = 2U << 28U;
  constexpr std::uint32_t kExternal = 1U << 22U;
  reg(rcc::kPllConfig) = (from_external ? kExternal | 4U : 8U) | kTimes168 | kDividedBy2 |
                         kUsbDividedBy7 | kAsAfterReset;
  set_bits(rcc::kCtrl, kOn);
  return wait_for(rcc::kCtrl, kLocked);
}

/// Lets the flash be read at 168 MHz and 3.3 V, through its caches.
bool slow_flash_down() {
  constexpr std::uint32_t kWaitStates = 5;
  constexpr std::uint32_t kPrefetchAndCaches = 7U << 8U;
  reg(flash::kAccess) = kPrefetchAndCaches | kWaitStates;
  return (read(flash::kAccess) & kWaitStates) == kWaitStates;
}

bool switch_to_pll() {
  constexpr std::uint32_t kApb1By4 = 5U << 10U;
  constexpr std::uint32_t kApb2By2 = 4U << 13U;
  constexpr std::uint32_t kPll = 2;
  constexpr std::uint32_t kPllInUse = 2U << 2U;
  reg(rcc::kConfig) = kApb1By4 | kApb2By2;
  reg(rcc::kConfig) = kApb1By4 | kApb2By2 | kPll;
  if (wait_for(rcc::kConfig, kPllInUse)) {
    return true;
  }
  reg(rcc::kConfig) = 0;
  return false;
}

}  // namespace

Clocks start_clocks() {
  if (!on_silicon()) {
    return kFromPll;
  }
  const bool started = start_pll(start_external()) && slow_flash_down() && switch_to_pll();
  return started ? kFromPll : kFromInternal;
}

}  // namespace penduline::stm32f4
