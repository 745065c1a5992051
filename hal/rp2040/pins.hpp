// SPDX-License-Identifier: Apache-2.0
// The RP2040's pins as outputs: the emitters and the light on the board.
#pragma once

#include <cstdint>

#include "hal/concepts.hpp"
#include "hal/rp2040/registers.hpp"

namespace penduline::rp2040 {

/// Connects a pin to a function, as an output of 4 mA with its input on and no pulls.
inline void connect_pin(std::uint32_t pin, std::uint32_t function) {
  constexpr std::uint32_t kInputOn = 1U << 6U;
  constexpr std::uint32_t kDrive4Ma = 1U << 4U;
  constexpr std::uint32_t kSchmittTrigger = 1U << 1U;
  reg(gpio::kPad + 4 * pin) = kInputOn | kDrive4Ma | kSchmittTrigger;
  reg(gpio::kFunction + 8 * pin) = function;
}

/// Pulls a connected pin up, so that it does not float where nothing is plugged in.
inline void pull_up(std::uint32_t pin) {
  constexpr std::uint32_t kPullUp = 1U << 3U;
  set_bits(gpio::kPad + 4 * pin, kPullUp);
}

/// Makes a pin analogue: no digital input, output or pull (4.9.1).
inline void make_analogue(std::uint32_t pin) {
  constexpr std::uint32_t kOutputOff = 1U << 7U;
  reg(gpio::kPad + 4 * pin) = kOutputOff;
  reg(gpio::kFunction + 8 * pin) = gpio::kFunctionNone;
}

/// A pin that is high where its light is to be lit.
template <std::uint32_t Pin>
class LightPin {
 public:
  static void start() {
    reg(gpio::kOutClear) = 1U << Pin;
    reg(gpio::kEnableSet) = 1U << Pin;
    connect_pin(Pin, gpio::kFunctionSio);
  }
  void set(bool lit) { reg(lit ? gpio::kOutSet : gpio::kOutClear) = 1U << Pin; }
};

static_assert(Emitter<LightPin<0>>);
static_assert(Indicator<LightPin<0>>);

}  // namespace penduline::rp2040
