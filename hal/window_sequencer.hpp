// SPDX-License-Identifier: Apache-2.0
// Takes a window burst by burst, in interrupts: switches the emitters, waits, converts.
#pragma once

#include <cstddef>
#include <cstdint>

#include "hal/concepts.hpp"
#include "hal/interrupt_ring.hpp"
#include "hal/window.hpp"

namespace penduline {

/// Windows that may wait for the main loop.
inline constexpr std::size_t kWaitingWindows = 4;

/// Runs through kBursts. All `on_...` are called from interrupts of one priority, `take` from the
/// main loop. No call takes longer than a burst that the converter does by itself.
template <Emitter Light, BurstConverter Adc, WakeUpTimer Timer>
class WindowSequencer {
 public:
  WindowSequencer(Light& emitter, Adc& adc, Timer& timer)
      : emitter_(emitter), adc_(adc), timer_(timer) {}

  /// A window is due; it is out of step where its first conversion begins more than `most_late_us`
  /// later. While the one before is still running, or nobody took the ones before, it is lost and
  /// counted.
  void on_window_due(std::uint64_t due_us, std::uint32_t most_late_us, EmitterMode mode) {
    Window* free = window_ == nullptr ? windows_.free_slot() : nullptr;
    if (free == nullptr) {
      on_window_missed();
      return;
    }
    window_ = free;
    most_late_us_ = most_late_us;
    window_->due_us = due_us;
    window_->mode = mode;
    window_->lost_before = lost_;
    lost_ = 0;
    burst_ = 0;
    begin_burst();
  }

  /// A window was due and could not begin at all.
  void on_window_missed() { ++lost_; }

  /// Whether no window is running.
  [[nodiscard]] bool idle() const { return window_ == nullptr; }

  /// The emitters have settled.
  void on_wake_up() {
    if (window_ != nullptr) {
      convert();
    }
  }

  /// The converter has filled in a burst.
  void on_burst_done() {
    if (window_ == nullptr) {
      return;
    }
    if (++burst_ < kBursts.size()) {
      begin_burst();
      return;
    }
    const std::uint64_t took_us = timer_.now_us() - window_->due_us - window_->late_us;
    window_->out_of_step =
        window_->late_us > most_late_us_ || took_us > kWindowUs + kWindowUs / kHeldUpShare;
    window_ = nullptr;
    windows_.put();
  }

  bool take(Window& window) {
    const Window* full = windows_.full_slot();
    if (full == nullptr) {
      return false;
    }
    window = *full;
    windows_.drop();
    return true;
  }

 private:
  static constexpr std::uint32_t kWindowUs = window_us(Adc::kConversionNs);

  [[nodiscard]] bool to_be_lit() const {
    return window_->mode == EmitterMode::kSwitched ? kBursts[burst_].lit
                                                   : window_->mode == EmitterMode::kLit;
  }

  /// Whether the plan switches the emitters before this burst. A mode that does not still waits, so
  /// that the windows of all modes have one length and one middle.
  [[nodiscard]] bool is_to_settle() const {
    return burst_ > 0 && kBursts[burst_].lit != kBursts[burst_ - 1].lit;
  }

  void begin_burst() {
    const bool switches = to_be_lit() != lit_;
    if (switches) {
      lit_ = !lit_;
      emitter_.set(lit_);
    }
    if (switches || is_to_settle()) {  // also before the first burst, where the mode has changed
      timer_.wake_after(kSettlingUs);
    } else {
      convert();
    }
  }

  void convert() {
    if (burst_ == 0) {
      window_->late_us = static_cast<std::uint32_t>(timer_.now_us() - window_->due_us);
    }
    std::uint16_t* codes = &window_->codes[burst_ * kConversionsPerBurst];
    if (adc_.convert(kBursts[burst_].first_channel, codes)) {
      on_burst_done();
    }
  }

  Light& emitter_;
  Adc& adc_;
  Timer& timer_;
  InterruptRing<Window, kWaitingWindows> windows_;
  Window* window_ = nullptr;        ///< the one that is running
  std::uint32_t most_late_us_ = 0;  ///< of it
  std::size_t burst_ = 0;
  std::uint32_t lost_ = 0;
  bool lit_ = false;
};

}  // namespace penduline
