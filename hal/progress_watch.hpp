// SPDX-License-Identifier: Apache-2.0
// Tells hardware that has stopped from hardware that has nothing to do.
#pragma once

#include <atomic>
#include <cstdint>

#include "hal/concepts.hpp"

namespace penduline {

/// Notes when the hardware last went on; a second without that, while it has something to do, is a
/// fault. Noted in an interrupt, asked in the main loop.
class ProgressWatch {
 public:
  void note(std::uint64_t now_us) {
    noted_us_.store(static_cast<std::uint32_t>(now_us), std::memory_order_release);
  }
  template <TickClock Clock>
  [[nodiscard]] bool overdue(const Clock& clock) const {
    constexpr std::uint32_t kPatienceUs = 1'000'000;
    // The clock is read last: an interrupt may note between the two.
    const std::uint32_t noted_us = noted_us_.load(std::memory_order_acquire);
    return static_cast<std::uint32_t>(clock.now_us()) - noted_us > kPatienceUs;
  }

 private:
  std::atomic<std::uint32_t> noted_us_{0};  ///< the clock's low word
};

}  // namespace penduline
