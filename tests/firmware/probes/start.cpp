// SPDX-License-Identifier: Apache-2.0
// Vector table and start-up of the probes; handlers that a probe does not define stop in a
// breakpoint.

using Handler = void (*)();

extern "C" {
extern unsigned __stack_top, __data_load, __data_start, __data_end, __bss_start, __bss_end;
int main();
void unexpected() {
  asm volatile("bkpt 1");
}
#define OPTIONAL_HANDLER __attribute__((weak, alias("unexpected")))
void on_hard_fault() OPTIONAL_HANDLER;
void on_systick() OPTIONAL_HANDLER;
void on_timer0() OPTIONAL_HANDLER;
void on_timer1() OPTIONAL_HANDLER;
void on_usb() OPTIONAL_HANDLER;
void on_dma0() OPTIONAL_HANDLER;
void on_uart0() OPTIONAL_HANDLER;
void on_adc() OPTIONAL_HANDLER;

[[noreturn]] void start() {
  const unsigned* from = &__data_load;
  for (unsigned* to = &__data_start; to != &__data_end;)
    *to++ = *from++;
  for (unsigned* to = &__bss_start; to != &__bss_end;)
    *to++ = 0;
  main();
  for (;;)
    asm volatile("wfi");
}

__attribute__((section(".vectors"), used))
const Handler vectors[48] = {reinterpret_cast<Handler>(&__stack_top),
                             start,
                             unexpected,
                             on_hard_fault,
                             nullptr,
                             nullptr,
                             nullptr,
                             nullptr,
                             nullptr,
                             nullptr,
                             nullptr,
                             unexpected,
                             nullptr,
                             nullptr,
                             unexpected,
                             on_systick,
                             on_timer0,
                             on_timer1,
                             unexpected,
                             unexpected,
                             unexpected,
                             on_usb,
                             unexpected,
                             unexpected,
                             unexpected,
                             unexpected,
                             unexpected,
                             on_dma0,
                             unexpected,
                             unexpected,
                             unexpected,
                             unexpected,
                             unexpected,
                             unexpected,
                             unexpected,
                             unexpected,
                             on_uart0,
                             unexpected,
                             on_adc,
                             unexpected,
                             unexpected,
                             unexpected,
                             unexpected,
                             unexpected,
                             unexpected,
                             unexpected,
                             unexpected,
                             unexpected};
}
