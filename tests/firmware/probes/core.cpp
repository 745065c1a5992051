// SPDX-License-Identifier: Apache-2.0
// Shows interrupts, sleep, SysTick, alarms and clocks as the Cortex-M0+ and the RP2040 have them.

#include "rp2040.hpp"

extern "C" {
volatile Word crystal_polls, pll_lock_while_off, resets_done_at_start, tick_register;
volatile Word software_interrupts, latched_interrupts, handled_in_critical, handled_after;
volatile Word systick_wakes, systick_count, systick_at_start, systick_first_us, systick_last_us;
volatile Word alarm_asked, alarm_seen, alarm_fired, already_pending_wakes, done;

void on_timer0() {
  alarm_seen = now_us();
  alarm_fired = alarm_fired + 1;
  write(kTimerInterrupts, 1);
}

void on_timer1() {
  software_interrupts = software_interrupts + 1;
}
void on_systick() {
  systick_last_us = now_us();
  if (systick_count == 0)
    systick_first_us = systick_last_us;
  systick_count = systick_count + 1;
}
}

static void probe_clocks() {
  resets_done_at_start = read(kResets + 8);
  release(kIoReset | kPadsReset | kPllsReset);
  pll_lock_while_off = read(kPllSys) >> 31;
  Word polls = 0;  // of about 10 cycles of 6.5 MHz
  write(kXosc + 0xc, 47);
  write(kXosc, 0xfabaa0);
  while (!(read(kXosc + 4) >> 31))
    ++polls;
  crystal_polls = polls;
  start_board();
  tick_register = read(kWatchdogTick) & 0x3ff;
}

static void probe_interrupts() {
  enable_interrupt(1);
  write(kNvicPend, 1u << 1);
  asm volatile("nop\nnop\nnop");

  disable_interrupts();
  enable_interrupt(0);
  write(kTimerEnables, 1);
  write(kTimerAlarm0, now_us() + 20);
  for (Word start = now_us(); now_us() - start < 50;) {
  }
  write(kTimerInterrupts, 1);  // the line falls, the NVIC remembers
  enable_interrupts();
  latched_interrupts = alarm_fired;

  alarm_fired = 0;
  disable_interrupts();
  write(kTimerAlarm0, now_us() + 100);
  sleep();
  handled_in_critical = alarm_fired;
  enable_interrupts();
  handled_after = alarm_fired;

  disable_interrupts();
  write(kNvicPend, 1u << 1);
  sleep();  // does not: there is work
  already_pending_wakes = 1;
  enable_interrupts();
}

static void probe_alarms() {
  alarm_asked = now_us() + 37;
  write(kTimerAlarm0, alarm_asked);
  alarm_fired = 0;
  while (!alarm_fired)
    sleep();
}

static void probe_systick() {
  write(kSysTickReload, 12499);
  write(kSysTickValue, 0);
  write(kSysTickControl, 7);
  asm volatile("nop\nnop");
  systick_at_start = systick_count;
  while (systick_count < 1001) {
    sleep();
    systick_wakes = systick_wakes + 1;
  }
  write(kSysTickControl, 0);
}

int main() {
  probe_clocks();
  probe_interrupts();
  probe_alarms();
  probe_systick();
  done = 1;
}
