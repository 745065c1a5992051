// SPDX-License-Identifier: Apache-2.0
// Windows at a steady rate on the RP2040: the timer begins them, the DMA ends their bursts.
#pragma once

#include <atomic>
#include <cstdint>

#include "hal/concepts.hpp"
#include "hal/rp2040/adc.hpp"
#include "hal/rp2040/timer.hpp"
#include "hal/window_schedule.hpp"
#include "hal/window_sequencer.hpp"

namespace penduline::rp2040 {

template <Emitter Light>
class Sampler {
 public:
  static constexpr std::uint32_t kWindowUs = window_us(Adc::kConversionNs);
  static constexpr std::uint16_t kTopCode = Adc::kTopCode;

  Sampler(Timer& timer, Adc& adc, Light& emitter)
      : timer_(timer), adc_(adc), sequencer_(emitter, adc, timer) {}

  void start(std::uint32_t period_us, EmitterMode mode) {
    if (schedule_.start(period_us, mode, timer_.now_us())) {
      Timer::set_window_alarm(schedule_.due_us());
    }
  }

  bool take(Window& window) { return sequencer_.take(window); }

  [[nodiscard]] std::uint16_t temperature_code() const {
    return temperature_code_.load(std::memory_order_relaxed);
  }

  void on_window_alarm() {
    Timer::acknowledge(Timer::kWindowAlarm);
    temperature_code_.store(adc_.last_code(), std::memory_order_relaxed);
    schedule_.on_alarm(sequencer_, timer_);
    Timer::set_window_alarm(schedule_.due_us());
  }

  void on_wake_up_alarm() {
    Timer::acknowledge(Timer::kWakeUpAlarm);
    sequencer_.on_wake_up();
  }

  /// True where a window is finished.
  bool on_burst_carried() {
    adc_.finish_burst();
    sequencer_.on_burst_done();
    if (!sequencer_.idle()) {
      return false;
    }
    adc_.start_temperature();
    return true;
  }

 private:
  Timer& timer_;
  Adc& adc_;
  WindowSequencer<Light, Adc, Timer> sequencer_;
  WindowSchedule schedule_;
  std::atomic<std::uint16_t> temperature_code_{0};
};

}  // namespace penduline::rp2040
