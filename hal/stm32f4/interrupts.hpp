// SPDX-License-Identifier: Apache-2.0
// Interrupts of the STM32F4: their handlers (defined in board.cpp) and their priorities.
#pragma once

#include <cstdint>

#include "hal/stm32f4/registers.hpp"

namespace penduline::stm32f4 {

void on_sys_tick();
void on_pend_sv();
void on_usart_2();

inline constexpr std::uint32_t kUsart2Interrupt = 38;  // RM0090 12.2
inline constexpr std::uint32_t kInterrupts = 97;       // of the F446, which has the more

/// The clock goes before all else, for a microsecond at most. The receiver has no FIFO, a byte must
/// be fetched within 22 us; so it interrupts the sampling, which takes 200 us and does not mind.
enum class Priority : std::uint32_t { kClock = 0x00, kLink = 0x40, kSampling = 0xc0 };

inline void set_system_priorities() {
  constexpr std::uint32_t kPendSvShift = 16;
  constexpr std::uint32_t kSysTickShift = 24;
  constexpr std::uint32_t kMask = (0xffU << kPendSvShift) | (0xffU << kSysTickShift);
  write_field(cortex::kSystemPriority3, kMask,
              (static_cast<std::uint32_t>(Priority::kSampling) << kPendSvShift) |
                  (static_cast<std::uint32_t>(Priority::kClock) << kSysTickShift));
}

inline void enable_usart_2() {
  reg(cortex::kNvicEnable + 4 * (kUsart2Interrupt / 32)) = 1U << (kUsart2Interrupt % 32);
}
inline void disable_usart_2() {
  reg(cortex::kNvicDisable + 4 * (kUsart2Interrupt / 32)) = 1U << (kUsart2Interrupt % 32);
  asm volatile("dsb\nisb" ::: "memory");
}
inline void start_usart_2_interrupt() {
  constexpr std::uint32_t kShift = 8 * (kUsart2Interrupt % 4);
  write_field(cortex::kNvicPriority + 4 * (kUsart2Interrupt / 4), 0xffU << kShift,
              static_cast<std::uint32_t>(Priority::kLink) << kShift);
  enable_usart_2();
}

}  // namespace penduline::stm32f4
