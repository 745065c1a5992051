// SPDX-License-Identifier: Apache-2.0
// The STM32F4's clocks: 168 MHz for the processor where its PLL comes up.
#pragma once

#include <cstdint>

#include "hal/stm32f4/registers.hpp"

namespace penduline::stm32f4 {

/// What runs how fast. The ADC's clock is at most 21 MHz in all cases.
struct Clocks {
  std::uint32_t processor_hz;  ///< whole megahertz
  std::uint32_t apb1_hz;       ///< of USART2
  std::uint32_t apb2_hz;       ///< of the ADC
};

/// Whether there is a chip around the processor. It cannot run with its internal oscillator off
/// right after a reset, so where the clock control says that, there is none: QEMU models the
/// processor and some peripherals of the F405, and has zeros where its clock control would be.
[[nodiscard]] inline bool on_silicon() {
  return read(rcc::kCtrl) != 0;
}

/// Starts the PLL from the ST-Link's 8 MHz, else from the internal 16 MHz; where it does not lock,
/// the processor stays with the latter. QEMU's processor runs at 168 MHz by itself.
[[nodiscard]] Clocks start_clocks();

}  // namespace penduline::stm32f4
