// SPDX-License-Identifier: Apache-2.0
// How much of its time the main loop is busy; interrupts that it sleeps through do not count.
#pragma once

#include <algorithm>
#include <cstdint>

namespace penduline {

class BusyMeter {
 public:
  void slept(std::uint64_t from_us, std::uint64_t to_us) { asleep_us_ += to_us - from_us; }

  /// The busy share since the last call, in thousandths.
  std::uint16_t take_permille(std::uint64_t now_us) {
    const std::uint64_t all_us = std::max<std::uint64_t>(now_us - since_us_, 1);
    const std::uint64_t busy_us = all_us - std::min(asleep_us_, all_us);
    since_us_ = now_us;
    asleep_us_ = 0;
    return static_cast<std::uint16_t>(busy_us * 1000 / all_us);
  }

 private:
  std::uint64_t since_us_ = 0;
  std::uint64_t asleep_us_ = 0;
};

}  // namespace penduline
