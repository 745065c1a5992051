// SPDX-License-Identifier: Apache-2.0
// Windows at a steady rate on the STM32F4: the timer's alarms begin them and their bursts.
#pragma once

#include <atomic>
#include <cstdint>

#include "hal/concepts.hpp"
#include "hal/stm32f4/adc.hpp"
#include "hal/stm32f4/timer.hpp"
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
    period_us_.store(period_us, std::memory_order_relaxed);
    mode_.store(mode, std::memory_order_relaxed);
    if (!running_) {
      running_ = true;
      due_us_ = timer_.now_us() + period_us;
      timer_.set_window_alarm(due_us_);
    }
  }

  bool take(Window& window) { return sequencer_.take(window); }

  /// To be called after each alarm, from one interrupt.
  void on_alarm() {
    if (timer_.take_wake_up()) {
      sequencer_.on_wake_up();
    }
    if (timer_.take_window_alarm()) {
      on_window_alarm();
    }
  }

 private:
  void on_window_alarm() {
    const std::uint64_t now_us = timer_.now_us();
    sequencer_.on_window_due(due_us_, static_cast<std::uint32_t>(now_us - due_us_),
                             mode_.load(std::memory_order_relaxed));
    const std::uint32_t period_us = period_us_.load(std::memory_order_relaxed);
    due_us_ += period_us;
    while (due_us_ < timer_.now_us()) {  // their time has passed
      sequencer_.on_window_missed();
      due_us_ += period_us;
    }
    timer_.set_window_alarm(due_us_);
  }

  Timer& timer_;
  WindowSequencer<Light, Adc, Timer> sequencer_;
  std::atomic<std::uint32_t> period_us_{0};
  std::atomic<EmitterMode> mode_{EmitterMode::kSwitched};
  std::uint64_t due_us_ = 0;
  bool running_ = false;
};

}  // namespace penduline::stm32f4
