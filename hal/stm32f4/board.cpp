// SPDX-License-Identifier: Apache-2.0
// The Nucleo put together: start-up, sleep, interrupts.
#include "hal/stm32f4/board.hpp"

#include "hal/cortex_m/interrupt_lock.hpp"
#include "hal/cortex_m/stack.hpp"
#include "hal/stm32f4/clocks.hpp"
#include "hal/stm32f4/interrupts.hpp"

namespace penduline::stm32f4 {
namespace {

Board board;
[[gnu::section(".kept")]] CrashRecord kept_crash_record;

}  // namespace

Board& nucleo() {
  return board;
}

void Board::start() {
  ResetControl::enter_requested_bootloader();
  const cortex_m::InterruptLock lock;
  const Clocks clocks = start_clocks();
  resets_.start();
  set_system_priorities();
  timer_.start(clocks.processor_hz);
  set_bits(rcc::kAhb1Enable, rcc::kGpioA);
  emitters_.start();
  light_.start();
  adc_.start(clocks.apb2_hz);
  uart_.start(clocks.apb1_hz);
  start_usart_2_interrupt();
}

CrashRecord& Board::crash_record() {
  return kept_crash_record;
}

std::uint32_t Board::stack_free_bytes() const {
  return cortex_m::unused_stack_bytes();
}

/// An interrupt that comes just before the wait is noted, so that it is not slept through: with
/// interrupts off `wfi` still wakes for one that is pending (ARMv7-M B1.5.19).
void Board::sleep() {
  asm volatile("cpsid i" ::: "memory");
  if (!interrupted_) {
    asm volatile("wfi" ::: "memory");
  }
  interrupted_ = false;
  asm volatile("cpsie i" ::: "memory");
}

void on_sys_tick() {
  board.note_interrupt();
  board.clock().on_interval();
}
void on_pend_sv() {
  board.note_interrupt();
  board.sampler().on_alarm();
}
void on_usart_2() {
  board.note_interrupt();
  board.uart().on_interrupt();
}

}  // namespace penduline::stm32f4
