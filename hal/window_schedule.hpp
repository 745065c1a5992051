// SPDX-License-Identifier: Apache-2.0
// When windows are due: a period after one another, however late one of them begins.
#pragma once

#include <atomic>
#include <cstdint>

#include "hal/concepts.hpp"
#include "hal/window.hpp"

namespace penduline {

/// The times of a sampler's windows, kept against its clock. A sampler has an alarm that it sets to
/// `due_us` after each call that changes it.
class WindowSchedule {
 public:
  /// Sets the period and the mode from the next window on. Called from the main loop; true where
  /// the windows begin with this call, one period from now.
  bool start(std::uint32_t period_us, EmitterMode mode, std::uint64_t now_us) {
    period_us_.store(period_us, std::memory_order_relaxed);
    mode_.store(mode, std::memory_order_relaxed);
    if (running_) {
      return false;
    }
    running_ = true;
    due_us_ = now_us + period_us;
    return true;
  }

  [[nodiscard]] std::uint64_t due_us() const { return due_us_; }

  /// The alarm has gone off: begins the window that is due and goes on to the next. Windows that
  /// are late by a whole period are missed. Called from the sampler's interrupt.
  template <class Sequencer, TickClock Clock>
  void on_alarm(Sequencer& sequencer, const Clock& clock) {
    const std::uint32_t period_us = period_us_.load(std::memory_order_relaxed);
    const std::uint64_t now_us = clock.now_us();
    while (due_us_ + period_us < now_us) {
      miss_one(sequencer, period_us);
    }
    sequencer.on_window_due(due_us_, period_us / kMostLateShare,
                            mode_.load(std::memory_order_relaxed));
    due_us_ += period_us;
    // An alarm set in the past might come an age later: the RP2040's after 71 minutes.
    while (due_us_ < clock.now_us() + kAlarmMarginUs) {
      miss_one(sequencer, period_us);
    }
  }

 private:
  static constexpr std::uint32_t kMostLateShare = 8;  ///< of a period; a power of two
  static constexpr std::uint64_t kAlarmMarginUs = 20;

  template <class Sequencer>
  void miss_one(Sequencer& sequencer, std::uint32_t period_us) {
    sequencer.on_window_missed();
    due_us_ += period_us;
  }

  std::atomic<std::uint32_t> period_us_{0};
  std::atomic<EmitterMode> mode_{EmitterMode::kSwitched};
  std::uint64_t due_us_ = 0;
  bool running_ = false;
};

}  // namespace penduline
