// SPDX-License-Identifier: Apache-2.0
// The moment that a linear-phase filter's output refers to: the middle of its window.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "common/fir.hpp"

namespace penduline {

/// Follows the times of the last samples.
class WindowMoment {
 public:
  WindowMoment() = default;
  /// A window of `samples` (1..kMaxTaps), nominally `period_us` apart.
  WindowMoment(std::size_t samples, std::int64_t period_us)
      : samples_(samples),
        nominal_delay_us_(static_cast<std::int64_t>(samples - 1) * period_us / 2) {}

  /// Takes the newest sample's time and returns the moment: midway between the oldest time in the
  /// window and the newest, or, until the window is full, by the nominal period.
  std::int64_t push(std::int64_t newest_us) {
    times_us_[next_] = newest_us;
    next_ = next_ + 1 == samples_ ? 0 : next_ + 1;
    seen_ += seen_ < samples_ ? 1 : 0;
    if (seen_ < samples_) {
      return newest_us - nominal_delay_us_;
    }
    const std::int64_t oldest_us = times_us_[next_];
    return oldest_us + (newest_us - oldest_us) / 2;
  }

  /// Forgets all times.
  void clear() {
    next_ = 0;
    seen_ = 0;
  }

 private:
  std::array<std::int64_t, kMaxTaps> times_us_{};
  std::size_t samples_ = 1;
  std::size_t next_ = 0;
  std::size_t seen_ = 0;
  std::int64_t nominal_delay_us_ = 0;
};

}  // namespace penduline
