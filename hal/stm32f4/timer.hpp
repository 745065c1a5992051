// SPDX-License-Identifier: Apache-2.0
// Time and alarms from the processor's SysTick alone (ARMv7-M B3.3).
#pragma once

#include <cstdint>
#include <limits>

#include "hal/concepts.hpp"
#include "hal/stm32f4/registers.hpp"

namespace penduline::stm32f4 {

/// SysTick counts down one interval after another. Each ends where the next alarm is due, or after
/// 50 ms; the time is the sum of those that have ended and what has passed of the one that runs.
/// The chip's own timers would do as well, but QEMU's copies of them do not.
class Timer {
 public:
  /// With interrupts off, once the processor's clock is what it will be.
  void start(std::uint32_t processor_hz);

  /// May be called from anywhere.
  [[nodiscard]] std::uint64_t now_us() const;

  void wake_after(std::uint32_t delay_us);
  void set_window_alarm(std::uint64_t at_us);
  /// Whether the alarm has gone off; forgets it if so.
  [[nodiscard]] bool take_wake_up() { return take(wake_up_us_); }
  [[nodiscard]] bool take_window_alarm() { return take(window_us_); }

  /// SysTick's interrupt: an interval has ended. Alarms are left to PendSV.
  void on_interval();

  /// Does the interrupt's counting while interrupts are off for long; called in a tight loop, from
  /// RAM: it calls nothing.
  [[gnu::always_inline]] void follow() {
    if ((reg(cortex::kInterruptCtrl) & cortex::kSysTickPending) != 0) {
      reg(cortex::kInterruptCtrl) = cortex::kSysTickClear;
      add(interval_ticks_);
      begin_interval(interval_ticks_);
    }
  }
  /// After `follow`: sees to the alarms again.
  void resume();

 private:
  static constexpr std::uint64_t kNever = std::numeric_limits<std::uint64_t>::max();

  /// ticks / ticks_per_us_ without a division: exact for two intervals of the longest, for they are
  /// 18 million ticks at 180 MHz, and the reciprocal's rounding is less than ticks_per_us_ in 2^32.
  [[gnu::always_inline]] [[nodiscard]] std::uint32_t whole_us(std::uint32_t ticks) const {
    return static_cast<std::uint32_t>((std::uint64_t{ticks} * us_per_tick_q32_) >> 32U);
  }
  [[gnu::always_inline]] void add(std::uint32_t ticks) {
    ticks += past_ticks_;
    const std::uint32_t us = whole_us(ticks);
    past_us_ += us;
    past_ticks_ = ticks - us * ticks_per_us_;
  }
  [[gnu::always_inline]] void begin_interval(std::uint32_t ticks) {
    interval_ticks_ = ticks;
    last_left_ = ticks;
  }
  [[nodiscard]] std::uint32_t ticks_left() const;
  [[nodiscard]] std::uint64_t us_after(std::uint32_t ticks) const {
    return past_us_ + whole_us(past_ticks_ + ticks);
  }
  [[nodiscard]] std::uint64_t now_us_locked() const;
  void set(std::uint64_t& alarm, std::uint64_t at_us);
  [[nodiscard]] bool take(std::uint64_t& alarm);
  void plan();

  std::uint32_t ticks_per_us_ = 1;
  std::uint32_t us_per_tick_q32_ = 0;    ///< 2^32 / ticks_per_us_, rounded up
  std::uint32_t interval_ticks_ = 0;     ///< length of the one that runs
  mutable std::uint32_t last_left_ = 0;  ///< of it, when it was last looked at
  std::uint64_t past_us_ = 0;            ///< at its beginning
  std::uint32_t past_ticks_ = 0;         ///< and these, less than a microsecond
  std::uint64_t window_us_ = kNever;
  std::uint64_t wake_up_us_ = kNever;
};

static_assert(TickClock<Timer>);
static_assert(WakeUpTimer<Timer>);

}  // namespace penduline::stm32f4
