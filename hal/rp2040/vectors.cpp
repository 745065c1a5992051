// SPDX-License-Identifier: Apache-2.0
// The RP2040's vector table (data sheet 2.3.2).
#include "hal/cortex_m/startup.hpp"
#include "hal/rp2040/interrupts.hpp"

namespace penduline::rp2040 {
namespace {

constexpr cortex_m::Handler on(Interrupt interrupt, cortex_m::Vector function) {
  return {cortex_m::kFirstInterrupt + static_cast<std::size_t>(interrupt), function};
}

[[gnu::section(".vectors"), gnu::used]] constinit const auto vector_table =
    cortex_m::make_vector_table<32>(
        {on(Interrupt::kTimer0, on_timer_0), on(Interrupt::kTimer1, on_timer_1),
         on(Interrupt::kTimer2, on_timer_2), on(Interrupt::kUsb, on_usb),
         on(Interrupt::kDma0, on_dma_0), on(Interrupt::kUart0, on_uart_0)});

}  // namespace
}  // namespace penduline::rp2040
