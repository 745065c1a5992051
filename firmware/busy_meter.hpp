// SPDX-License-Identifier: Apache-2.0
// How much of its time the main loop is busy; interrupts that it sleeps through do not count.
#pragma once

#include <algorithm>
#include <cstdint>

namespace penduline {

class BusyMeter {
 public:
  void slept(std::uint64_t from_us, std::uint64_t to_us) { asleep_us_ += to_us - from_us; }

  /// Begins a new period.
  void begin(std::uint64_t now_us) {
    since_us_ = now_us;
    asleep_us_ = 0;
  }

  /// The busy share since the period began, in thousandths.
  [[nodiscard]] std::uint16_t permille(std::uint64_t now_us) const {
    const std::uint64_t all_us = std::max<std::uint64_t>(now_us - since_us_, 1);
    const std::uint64_t busy_us = all_us - std::min(asleep_us_, all_us);
    return static_cast<std::uint16_t>(busy_us * 1000 / all_us);
  }

 private:
  std::uint64_t since_us_ = 0;
  std::uint64_t asleep_us_ = 0;
};

}  // namespace penduline
