// SPDX-License-Identifier: Apache-2.0
// The Pico put together: start-up, sleep, interrupts.
#include "hal/rp2040/board.hpp"

#include "common/wire/device_messages.hpp"
#include "hal/cortex_m/stack.hpp"
#include "hal/program.hpp"
#include "hal/rp2040/clocks.hpp"
#include "hal/rp2040/interrupts.hpp"

namespace penduline::rp2040 {
namespace {

Board board;
[[gnu::section(".kept")]] CrashRecord kept_crash_record;

}  // namespace

Board& pico() {
  return board;
}

void Board::start() {
  id_.start();  // before anything may interrupt it
  PENDULINE_REQUIRE(restart_peripheral(resets::kIoBank0));
  PENDULINE_REQUIRE(restart_peripheral(resets::kPadsBank0));
  PENDULINE_REQUIRE(start_clocks());
  PENDULINE_REQUIRE(Timer::start());
  PENDULINE_REQUIRE(adc_.start());
  Emitters::start();
  LightPin<kLightPin>::start();
  PENDULINE_REQUIRE(uart_.start());
  PENDULINE_REQUIRE(usb_.start(id_.unique_id()));
  for (const Interrupt sampling : {Interrupt::kTimer0, Interrupt::kTimer1, Interrupt::kDma0}) {
    start_interrupt(sampling, Priority::kSampling);
  }
  for (const Interrupt other : {Interrupt::kTimer2, Interrupt::kUsb, Interrupt::kUart0}) {
    start_interrupt(other, Priority::kLink);
  }
}

CrashRecord& Board::crash_record() {
  return kept_crash_record;
}

std::uint32_t Board::stack_free_bytes() const {
  return cortex_m::unused_stack_bytes();
}

/// 27 degC - (V - 0.706 V) / 1.721 mV/K (data sheet 4.9.5), in hundredths and integers.
std::int16_t Board::temperature_cdeg() const {
  const std::uint32_t code = sampler_.temperature_code();
  if (code == 0) {
    return wire::kUnknownTemperature;
  }
  const auto uv = static_cast<std::int32_t>(std::uint64_t{code} * kReferenceUv / Adc::kTopCode);
  return static_cast<std::int16_t>(2700 - (uv - 706'000) * 100 / 1721);
}

/// An interrupt that comes just before the wait is not slept through: with interrupts off `wfi`
/// still wakes for one that is pending (ARMv6-M B1.5.19). Most have nothing for the main loop.
void Board::sleep() {
  asm volatile("cpsid i" ::: "memory");
  while (!work_) {
    asm volatile("wfi\n cpsie i\n isb\n cpsid i" ::: "memory");
  }
  work_ = false;
  asm volatile("cpsie i" ::: "memory");
}

void on_timer_0() {
  board.sampler().on_window_alarm();
}
void on_timer_1() {
  board.sampler().on_wake_up_alarm();
}
void on_timer_2() {
  Timer::acknowledge(Timer::kTickAlarm);
  Timer::set_tick_alarm();
  board.wake();
}
void on_dma_0() {
  if (board.sampler().on_burst_carried()) {
    board.wake();
  }
}
void on_usb() {
  if (board.usb().on_interrupt()) {
    board.wake();
  }
}
void on_uart_0() {
  if (board.uart().on_interrupt()) {
    board.wake();
  }
}

}  // namespace penduline::rp2040
