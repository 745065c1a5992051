// SPDX-License-Identifier: Apache-2.0
// The STM32F4's vector table (RM0090 12.2).
#include "hal/cortex_m/startup.hpp"
#include "hal/stm32f4/interrupts.hpp"

namespace penduline::stm32f4 {
namespace {

constexpr std::size_t kPendSv = 14;
constexpr std::size_t kSysTick = 15;

[[gnu::section(".vectors"), gnu::used]] constinit const auto vector_table =
    cortex_m::make_vector_table<kInterrupts>(
        {{kPendSv, on_pend_sv},
         {kSysTick, on_sys_tick},
         {cortex_m::kFirstInterrupt + kUsart2Interrupt, on_usart_2}});

}  // namespace
}  // namespace penduline::stm32f4
