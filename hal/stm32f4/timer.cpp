// SPDX-License-Identifier: Apache-2.0
// How SysTick's intervals become time and alarms.
#include "hal/stm32f4/timer.hpp"

#include <algorithm>

#include "hal/cortex_m/interrupt_lock.hpp"

namespace penduline::stm32f4 {
namespace {

constexpr std::uint32_t kLongestUs = 50'000;  // 24 bits are 99 ms
// Of an interval, and of what is left of one that is still to be replanned.
constexpr std::uint32_t kFewestTicks = 1000;
constexpr std::uint32_t kCloseTicks = 200;

[[nodiscard]] bool interval_ended() {
  return (read(cortex::kInterruptCtrl) & cortex::kSysTickPending) != 0;
}

/// What the counter shows. On the chip it is 0 for one tick between an interval's end, or the
/// counter's restart, and its next beginning. QEMU's shows 0 until its main loop has seen to it.
[[nodiscard]] std::uint32_t counter() {
  constexpr int kLooks = 4;
  std::uint32_t left = 0;
  for (int look = 0; look < kLooks && left == 0; ++look) {
    left = read(cortex::kSysTickValue);
  }
  return left;
}

void pend_sampling() {
  reg(cortex::kInterruptCtrl) = cortex::kPendSvSet;
}

}  // namespace

void Timer::start(std::uint32_t processor_hz) {
  constexpr std::uint32_t kOnWithInterruptFromProcessor = 7;
  ticks_per_us_ = processor_hz / 1'000'000;
  us_per_tick_q32_ =
      static_cast<std::uint32_t>(((std::uint64_t{1} << 32U) + ticks_per_us_ - 1) / ticks_per_us_);
  begin_interval(kLongestUs * ticks_per_us_);
  reg(cortex::kSysTickReload) = interval_ticks_ - 1;
  reg(cortex::kSysTickValue) = 0;
  reg(cortex::kSysTickCtrl) = kOnWithInterruptFromProcessor;
}

std::uint64_t Timer::now_us() const {
  const cortex_m::InterruptLock lock;
  return now_us_locked();
}

std::uint64_t Timer::now_us_locked() const {
  const std::uint32_t left = ticks_left();
  if (interval_ended()) {  // and the next, as long, has begun: before or after `left` was read
    const std::uint32_t left_of_next = counter();
    return us_after(interval_ticks_ + (left_of_next == 0 ? 0 : interval_ticks_ - left_of_next));
  }
  return us_after(interval_ticks_ - left);
}

/// Of the interval that runs. While the counter shows 0, time stands.
std::uint32_t Timer::ticks_left() const {
  const std::uint32_t left = counter();
  if (left != 0) {
    last_left_ = left;
  }
  return last_left_;
}

void Timer::wake_after(std::uint32_t delay_us) {
  const cortex_m::InterruptLock lock;
  set(wake_up_us_, now_us_locked() + delay_us);
}

void Timer::set_window_alarm(std::uint64_t at_us) {
  const cortex_m::InterruptLock lock;
  set(window_us_, at_us);
}

void Timer::set(std::uint64_t& alarm, std::uint64_t at_us) {
  alarm = at_us;
  plan();
}

bool Timer::take(std::uint64_t& alarm) {
  const cortex_m::InterruptLock lock;
  if (alarm > now_us_locked()) {
    return false;
  }
  alarm = kNever;
  return true;
}

void Timer::on_interval() {
  const cortex_m::InterruptLock lock;
  add(interval_ticks_);
  begin_interval(interval_ticks_);
  plan();
}

void Timer::resume() {
  const cortex_m::InterruptLock lock;
  plan();
}

/// Lets the interval end where the next alarm is due, by beginning a new one now. Alarms whose time
/// has come are handed to PendSV.
void Timer::plan() {
  // Between reading the counter and its restart, by the processor's data sheet.
  constexpr std::uint32_t kRestartTicks = 2;
  const std::uint32_t left = ticks_left();
  if (interval_ended() || left < kCloseTicks) {
    return;  // its interrupt, which is due or nearly so, comes here again
  }
  const std::uint32_t passed = past_ticks_ + interval_ticks_ - left;
  const std::uint32_t passed_us = whole_us(passed);
  const std::uint64_t now_us = past_us_ + passed_us;
  std::uint64_t wait_us = kLongestUs;
  for (const std::uint64_t alarm_us : {window_us_, wake_up_us_}) {
    if (alarm_us > now_us) {
      wait_us = std::min(wait_us, alarm_us - now_us);
    } else {
      pend_sampling();
    }
  }
  const std::uint32_t ticks = std::max(
      static_cast<std::uint32_t>(wait_us) * ticks_per_us_ - (passed - passed_us * ticks_per_us_),
      kFewestTicks);
  reg(cortex::kSysTickReload) = ticks - 1;
  const std::uint32_t still_left = read(cortex::kSysTickValue);
  reg(cortex::kSysTickValue) = 0;
  if (interval_ended()) {  // QEMU may take its time even here
    reg(cortex::kInterruptCtrl) = cortex::kSysTickClear;
    add(interval_ticks_);
  } else {
    add(interval_ticks_ - still_left + kRestartTicks);
  }
  begin_interval(ticks);
}

}  // namespace penduline::stm32f4
