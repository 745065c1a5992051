// SPDX-License-Identifier: Apache-2.0
// Uses clocks, UART, ADC, pins and memory rightly, but for the one mistake that the macro plants.

#include "rp2040.hpp"

enum class Mistake {
  none,
  adc_in_reset,
  no_tick,
  slow_tick,
  early_crystal,
  early_pll,
  pll_powered_down,
  too_fast,
  slow_vco,
  aux_in_use,
  no_clk_peri,
  uart_off,
  uart_function,
  uart_pad,
  uart_overrun,
  no_clk_adc,
  adc_digital_input,
  adc_pull,
  no_temperature_sensor,
  adc_dma_threshold,
  led_function,
  crooked_vectors,
  writes_flash,
  writes_rom,
  ssi_enabled,
  ssi_no_mode,
  unaligned_read,
  unaligned_write,
  unmapped,
  undefined_instruction,
  breakpoint,
};

#ifdef MISTAKE
constexpr Mistake kMistake = Mistake::MISTAKE;
#else
constexpr Mistake kMistake = Mistake::none;
#endif
constexpr bool wrong(Mistake mistake) {
  return mistake == kMistake;
}

extern "C" {
volatile Word faults, done;
void on_hard_fault() {
  faults = faults + 1;
  for (;;)
    sleep();
}
}

static void set_up_clocks() {
  release(kIoReset | kPadsReset | kPllsReset);
  if (wrong(Mistake::early_pll))
    start_pll(kPllUsb, 100, 5, 5);
  if (wrong(Mistake::early_crystal))
    write(kClkRefControl, 2);
  start_crystal();
  write(kClkRefControl, 2);
  start_pll(kPllSys, wrong(Mistake::slow_vco) ? 60 : 125, wrong(Mistake::too_fast) ? 5 : 6, 2);
  start_pll(kPllUsb, 100, 5, 5);
  if (wrong(Mistake::pll_powered_down))
    set_bits(kPllSys + 4, 1u << 3);
  write(kClkSysControl, 0);
  write(kClkSysControl, 1);
  if (wrong(Mistake::aux_in_use))
    write(kClkSysControl, 1u << 5 | 1);
  if (!wrong(Mistake::no_clk_peri))
    write(kClkPeriControl, 1u << 11);
  if (!wrong(Mistake::no_clk_adc))
    write(kClkAdcControl, 1u << 11);
  if (!wrong(Mistake::no_tick))
    write(kWatchdogTick, (wrong(Mistake::slow_tick) ? 125 : 12) | 1u << 9);
}

static void use_uart() {
  start_uart();
  if (wrong(Mistake::uart_off))
    write(kUart0 + 0x30, 1u << 9 | 1u << 8);
  if (wrong(Mistake::uart_function))
    choose_function(0, 5);
  if (wrong(Mistake::uart_pad))
    set_bits(kPadsBank0 + 4, 1u << 7);
  for (Word i = 0; i < (wrong(Mistake::uart_overrun) ? 34 : 33); ++i)
    write(kUartData, 'x');
}

static void use_adc() {
  choose_analog(26);
  if (wrong(Mistake::adc_digital_input))
    set_bits(kPadsBank0 + 4 + 4 * 26, 1u << 6);
  if (wrong(Mistake::adc_pull))
    set_bits(kPadsBank0 + 4 + 4 * 26, 1u << 2);
  const Word threshold = wrong(Mistake::adc_dma_threshold) ? 2 : 1;
  write(kAdcFifoControl, threshold << 24 | 1u << 3 | 1);
  for (Word channel = 0; channel <= 4; channel += 4) {
    const Word sensor = wrong(Mistake::no_temperature_sensor) ? 0 : 1u << 1;
    write(kAdcControl, channel << 12 | 1u << 2 | sensor | 1);
    while (!(read(kAdcControl) & 1u << 8)) {
    }
  }
}

static void use_led() {
  if (!wrong(Mistake::led_function))
    choose_function(25, 5);
  write(kSio + 0x24, 1u << 25);
  write(kSio + 0x14, 1u << 25);
}

/// Drops flash and SSI mistakes that need no more set-up than an address.
static void use_memory() {
  if (wrong(Mistake::crooked_vectors))
    write(0xe000ed08, 0x10000140);
  if (wrong(Mistake::writes_flash))
    write(0x10010000, 1);
  if (wrong(Mistake::writes_rom))
    write(0x100, 1);
  if (wrong(Mistake::ssi_enabled))
    write(0x18000014, 8);
  if (wrong(Mistake::ssi_no_mode))
    write(0x18000060, 0x9f);
  if (wrong(Mistake::unaligned_read))
    asm volatile("ldr r0, [%0]" ::"r"(0x20000002) : "r0");
  if (wrong(Mistake::unaligned_write))
    asm volatile("str %0, [%0]" ::"r"(0x20000002) : "memory");
  if (wrong(Mistake::unmapped))
    read(0x60000000);
  if (wrong(Mistake::undefined_instruction))
    asm volatile("udf #7");
  if (wrong(Mistake::breakpoint))
    asm volatile("bkpt 1");
}

int main() {
  set_up_clocks();
  release(kTimerReset | kUartReset | (wrong(Mistake::adc_in_reset) ? 0 : kAdcReset));
  const Word start = now_us();
  while (now_us() - start < 10) {
  }
  use_uart();
  use_led();
  use_memory();
  done = 1;
  use_adc();
}
