// SPDX-License-Identifier: Apache-2.0
// The STM32F4's pins of port A (RM0090 8.4).
#pragma once

#include <cstdint>

#include "hal/concepts.hpp"
#include "hal/stm32f4/registers.hpp"

namespace penduline::stm32f4 {

enum class PinMode : std::uint32_t { kInput = 0, kOutput = 1, kFunction = 2, kAnalogue = 3 };

/// Its pulls are off, as after a reset.
inline void set_pin_mode(std::uint32_t pin, PinMode mode) {
  write_field(gpio_a::kMode, 3U << (2 * pin), static_cast<std::uint32_t>(mode) << (2 * pin));
}

/// Connects one of the pins 0 to 7 to a peripheral.
inline void connect_pin(std::uint32_t pin, std::uint32_t function) {
  write_field(gpio_a::kFunctionLow, 0xfU << (4 * pin), function << (4 * pin));
  set_pin_mode(pin, PinMode::kFunction);
}

/// Lets a pin that nobody drives be high.
inline void pull_up(std::uint32_t pin) {
  write_field(gpio_a::kPulls, 3U << (2 * pin), 1U << (2 * pin));
}

/// A pin that is high where its light is to be lit.
template <std::uint32_t Pin>
class LightPin {
 public:
  void start() {
    set(false);
    set_pin_mode(Pin, PinMode::kOutput);
  }
  void set(bool lit) { reg(gpio_a::kSetReset) = 1U << (lit ? Pin : Pin + 16); }
};

static_assert(Emitter<LightPin<0>>);
static_assert(Indicator<LightPin<0>>);

}  // namespace penduline::stm32f4
