// SPDX-License-Identifier: Apache-2.0
// The RP2040's clocks: 125 MHz for the processor, 48 MHz for USB and ADC, a microsecond tick.
#pragma once

#include <cstdint>

namespace penduline::rp2040 {

inline constexpr std::uint32_t kSystemHz = 125'000'000;

/// Starts them from the Pico's 12 MHz crystal; false where the crystal or a PLL does not come up.
[[nodiscard]] bool start_clocks();

}  // namespace penduline::rp2040
