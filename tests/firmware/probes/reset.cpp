// SPDX-License-Identifier: Apache-2.0
// Shows what resets keep: watchdog time-out, watchdog trigger, the processor alone, and a recorded
// HardFault.

#include "rp2040.hpp"

extern "C" {
volatile Word timer_at_start, done;
__attribute__((section(".kept"))) volatile Word kept, fault_pc, reasons[5], uart_divisors[5];

void note_fault(const Word* frame) {
  fault_pc = frame[6];
  write(kWatchdogControl, 1u << 31);
  for (;;) {
  }
}

__attribute__((naked)) void on_hard_fault() {
  asm volatile("mrs r0, msp\nbl note_fault");
}

__attribute__((naked, noinline)) void fault_here() {
  asm volatile("movs r0, #1\nldr r0, [r0]\nbx lr");
}
}

int main() {
  const Word scratch = read(kWatchdogScratch0);
  if (scratch == 0)
    kept = 100;
  kept = kept + 1;
  reasons[scratch] = read(kWatchdogReason);
  uart_divisors[scratch] = read(kResets + 8) & kUartReset ? read(kUart0 + 0x24) : 0;
  write(kWatchdogScratch0, scratch + 1);
  start_board();
  timer_at_start = now_us();
  start_uart();
#ifndef MISTAKE_NO_SELECTION
  write(kPsm + 8, 0x1fffc);
#endif
  if (scratch == 0) {
    write(kWatchdogLoad, 2 * 5000);
    write(kWatchdogControl, 1u << 30);
    for (;;) {
    }
  }
  if (scratch == 1)
    write(kWatchdogControl, 1u << 31);
  if (scratch == 2)
    write(kSystemReset, 0x05fa0004);
  if (scratch == 3)
    fault_here();
  done = 1;
}
