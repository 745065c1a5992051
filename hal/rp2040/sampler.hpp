// SPDX-License-Identifier: Apache-2.0
// Windows at a steady rate on the RP2040: the timer begins them, the DMA ends their bursts.
#pragma once

#include <atomic>
#include <cstdint>

#include "hal/concepts.hpp"
#include "hal/rp2040/adc.hpp"
#include "hal/rp2040/timer.hpp"
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
    period_us_.store(period_us, std::memory_order_relaxed);
    mode_.store(mode, std::memory_order_relaxed);
    if (!running_) {
      running_ = true;
      due_us_ = timer_.now_us() + period_us;
      Timer::set_window_alarm(due_us_);
    }
  }

  bool take(Window& window) { return sequencer_.take(window); }

  [[nodiscard]] std::uint16_t temperature_code() const {
    return temperature_code_.load(std::memory_order_relaxed);
  }

  void on_window_alarm() {
    Timer::acknowledge(Timer::kWindowAlarm);
    const std::uint64_t now_us = timer_.now_us();
    temperature_code_.store(adc_.last_code(), std::memory_order_relaxed);
    const std::uint32_t period_us = period_us_.load(std::memory_order_relaxed);
    const auto late_us = static_cast<std::uint32_t>(now_us - due_us_);
    if (late_us <= period_us / kMostLateShare) {
      sequencer_.on_window_due(due_us_, late_us, mode_.load(std::memory_order_relaxed));
    } else {
      sequencer_.on_window_missed();  // rather a gap than a sample out of step
    }
    due_us_ += period_us;
    // An alarm in the past would come 71 minutes late: windows whose time has passed are lost.
    while (due_us_ < timer_.now_us() + kAlarmMarginUs) {
      sequencer_.on_window_missed();
      due_us_ += period_us;
    }
    Timer::set_window_alarm(due_us_);
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
  static constexpr std::uint64_t kAlarmMarginUs = 20;
  static constexpr std::uint32_t kMostLateShare = 8;  ///< of a period; a power of two

  Timer& timer_;
  Adc& adc_;
  WindowSequencer<Light, Adc, Timer> sequencer_;
  std::atomic<std::uint32_t> period_us_{0};
  std::atomic<EmitterMode> mode_{EmitterMode::kSwitched};
  std::atomic<std::uint16_t> temperature_code_{0};
  std::uint64_t due_us_ = 0;
  bool running_ = false;
};

}  // namespace penduline::rp2040
