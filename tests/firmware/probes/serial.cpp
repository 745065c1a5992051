// SPDX-License-Identifier: Apache-2.0
// Shows UART0: transmit interrupt on passing a level only, real time, receive timeout; echoes what
// arrives.

#include "rp2040.hpp"

constexpr Word kTransmit = 1u << 5, kReceive = 1u << 4, kTimeout = 1u << 6;

extern "C" {
volatile Word interrupts_before_data, sent_us, transmit_interrupts, receive_interrupts, received,
    done;
std::uint8_t text[64];

void on_uart0() {
  const Word status = read(kUart0 + 0x40);
  if (status & kTransmit)
    transmit_interrupts = transmit_interrupts + 1;
  if (status & (kReceive | kTimeout))
    receive_interrupts = receive_interrupts + 1;
  while (!(read(kUartFlags) & 1u << 4)) {
    text[received & 63] = static_cast<std::uint8_t>(read(kUartData));
    received = received + 1;
  }
  write(kUartClear, status);
}
}

int main() {
  start_board();
  start_uart();
  enable_interrupt(20);
  write(kUartMask, kTransmit | kReceive | kTimeout);
  asm volatile("nop\nnop");
  interrupts_before_data = transmit_interrupts;
  const Word start = now_us();
  for (Word i = 0; i < 24; ++i)
    write(kUartData, 'a' + i);
  while (read(kUartFlags) & 1u << 3) {
  }
  sent_us = now_us() - start;
  done = 1;
  for (Word echoed = 0;;) {
    while (echoed == received)
      sleep();
    write(kUartData, text[echoed++ & 63]);
  }
}
