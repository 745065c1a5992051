// SPDX-License-Identifier: Apache-2.0
// The RP2040's 64-bit microsecond timer and three of its alarms (data sheet 4.6).
#pragma once

#include <cstdint>

#include "hal/concepts.hpp"
#include "hal/rp2040/registers.hpp"

namespace penduline::rp2040 {

class Timer {
 public:
  static constexpr std::uint32_t kWindowAlarm = 1U << 0U;
  static constexpr std::uint32_t kWakeUpAlarm = 1U << 1U;
  static constexpr std::uint32_t kTickAlarm = 1U << 2U;

  [[nodiscard]] static bool start() {
    const bool started = restart_peripheral(resets::kTimer);
    reg(timer::kInterruptEnable) = kWindowAlarm | kWakeUpAlarm | kTickAlarm;
    set_tick_alarm();
    return started;
  }

  /// May be called from anywhere: read without the latch, which an interrupt could spoil.
  [[nodiscard]] std::uint64_t now_us() const {
    std::uint32_t high = read(timer::kRawHigh);
    while (true) {
      const std::uint32_t low = read(timer::kRawLow);
      const std::uint32_t high_after = read(timer::kRawHigh);
      if (high == high_after) {
        return (std::uint64_t{high} << 32U) | low;
      }
      high = high_after;  // the low word went over, which it does not do twice in a row
    }
  }

  void wake_after(std::uint32_t delay_us) { reg(timer::kAlarm1) = read(timer::kRawLow) + delay_us; }

  static void set_window_alarm(std::uint64_t at_us) {
    reg(timer::kAlarm0) = static_cast<std::uint32_t>(at_us);
  }
  /// Wakes the main loop where nothing else does.
  static void set_tick_alarm() {
    constexpr std::uint32_t kTickUs = 100'000;
    reg(timer::kAlarm2) = read(timer::kRawLow) + kTickUs;
  }
  static void acknowledge(std::uint32_t alarm) { reg(timer::kInterrupts) = alarm; }
};

static_assert(TickClock<Timer>);
static_assert(WakeUpTimer<Timer>);

}  // namespace penduline::rp2040
