// SPDX-License-Identifier: Apache-2.0
// Windows at a steady rate on the STM32F4: the timer's alarms begin them and their bursts.
#pragma once

#include <cstdint>

#include "hal/concepts.hpp"
#include "hal/stm32f4/adc.hpp"
#include "hal/stm32f4/timer.hpp"
#include "hal/window_schedule.hpp"
#include "hal/window_sequencer.hpp"

namespace penduline::stm32f4 {

template <Emitter Light>
class Sampler {
 public:
  static constexpr std::uint32_t kWindowUs = window_us(Adc::kConversionNs);
  static constexpr std::uint16_t kTopCode = Adc::kTopCode;

  Sampler(Timer& timer, Adc& adc, Light& emitter)
      : timer_(timer), sequencer_(emitter, adc, timer) {}

  void start(std::uint32_t period_us, EmitterMode mode) {
    if (schedule_.start(period_us, mode, timer_.now_us())) {
      timer_.set_window_alarm(schedule_.due_us());
    }
  }

  bool take(Window& window) { return sequencer_.take(window); }

  /// To be called after each alarm, from one interrupt.
  void on_alarm() {
    if (timer_.take_wake_up()) {
      sequencer_.on_wake_up();
    }
    if (timer_.take_window_alarm()) {
      schedule_.on_alarm(sequencer_, timer_);
      timer_.set_window_alarm(schedule_.due_us());
    }
  }

 private:
  Timer& timer_;
  WindowSequencer<Light, Adc, Timer> sequencer_;
  WindowSchedule schedule_;
};

}  // namespace penduline::stm32f4
