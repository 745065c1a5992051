// SPDX-License-Identifier: Apache-2.0
// Starting the clocks (RP2040 data sheet 2.15 to 2.18).
#include "hal/rp2040/clocks.hpp"

#include "hal/rp2040/registers.hpp"

namespace penduline::rp2040 {
namespace {

constexpr std::uint32_t kCrystalMhz = 12;

bool start_crystal() {
  constexpr std::uint32_t kDelay = 47;  // 1 ms, in 256 cycles of the crystal
  constexpr std::uint32_t kEnableUpTo15Mhz = 0xfabaa0;
  reg(xosc::kStartup) = kDelay;
  reg(xosc::kCtrl) = kEnableUpTo15Mhz;
  return wait_for(xosc::kStatus, 1U << 31U);
}

/// crystal * feedback / (divider1 * divider2) (2.18.2)
bool start_pll(std::uint32_t base, std::uint32_t feedback, std::uint32_t divider1,
               std::uint32_t divider2) {
  constexpr std::uint32_t kMainAndVcoOff = (1U << 0U) | (1U << 5U);
  constexpr std::uint32_t kPostDividersOff = 1U << 3U;
  reg(base + pll::kCs) = 1;  // reference divider
  reg(base + pll::kFeedback) = feedback;
  clear_bits(base + pll::kPower, kMainAndVcoOff);
  if (!wait_for(base + pll::kCs, 1U << 31U)) {
    return false;
  }
  reg(base + pll::kPostDividers) = (divider1 << 16U) | (divider2 << 12U);
  clear_bits(base + pll::kPower, kPostDividersOff);
  return true;
}

}  // namespace

bool start_clocks() {
  constexpr std::uint32_t kFromAux = 1;
  constexpr std::uint32_t kRefFromCrystal = 2;
  if (!start_crystal()) {
    return false;
  }
  // The system runs from the reference while its PLL is changed.
  clear_bits(clocks::kSysCtrl, kFromAux);
  if (!wait_for(clocks::kSysSelected, 1U << 0U)) {
    return false;
  }
  reg(clocks::kRefCtrl) = kRefFromCrystal;
  if (!wait_for(clocks::kRefSelected, 1U << kRefFromCrystal) ||
      !restart_peripheral(resets::kPllSys) || !restart_peripheral(resets::kPllUsb) ||
      !start_pll(pll::kSys, 125, 6, 2) || !start_pll(pll::kUsb, 100, 5, 5)) {
    return false;
  }
  reg(clocks::kSysCtrl) = 0;  // auxiliary source: the system's PLL
  set_bits(clocks::kSysCtrl, kFromAux);
  if (!wait_for(clocks::kSysSelected, 1U << kFromAux)) {
    return false;
  }
  reg(clocks::kPeriCtrl) = clocks::kEnable;  // from the system's clock
  reg(clocks::kUsbCtrl) = clocks::kEnable;   // from the USB's PLL
  reg(clocks::kAdcCtrl) = clocks::kEnable;   // from the USB's PLL
  // One tick a microsecond for timer and watchdog; without it both stand still.
  reg(watchdog::kTick) = kCrystalMhz | (1U << 9U);
  return true;
}

}  // namespace penduline::rp2040
