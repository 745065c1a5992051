// SPDX-License-Identifier: Apache-2.0
// Time that passes only when the simulated board waits, and the alarms that are set in it.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "hal/concepts.hpp"

namespace penduline::sim {

/// What may wake the board; of two that are due at one moment the first here comes first.
enum class Alarm : std::uint8_t { kWindow, kSettled, kBurst, kTick };

class VirtualClock {
 public:
  VirtualClock() { alarms_us_.fill(kNever); }

  [[nodiscard]] std::uint64_t now_us() const { return now_us_; }

  void set_alarm(Alarm alarm, std::uint64_t at_us) {
    alarms_us_[static_cast<std::size_t>(alarm)] = at_us;
  }
  void wake_after(std::uint32_t delay_us) { set_alarm(Alarm::kSettled, now_us_ + delay_us); }

  /// Lets the time pass to the next alarm, of which there must be one, and takes it. An alarm whose
  /// time is over comes at once, and late.
  Alarm wait() {
    std::size_t next = 0;
    for (std::size_t i = 1; i < alarms_us_.size(); ++i) {
      next = alarms_us_[i] < alarms_us_[next] ? i : next;
    }
    now_us_ = std::max(now_us_, alarms_us_[next]);
    alarms_us_[next] = kNever;
    return static_cast<Alarm>(next);
  }

  /// Lets the time pass with interrupts off: alarms that become due meanwhile come late.
  void pass_us(std::uint64_t us) { now_us_ += us; }

 private:
  static constexpr std::uint64_t kNever = std::numeric_limits<std::uint64_t>::max();

  std::uint64_t now_us_ = 0;
  std::array<std::uint64_t, 4> alarms_us_{};
};

static_assert(TickClock<VirtualClock>);
static_assert(WakeUpTimer<VirtualClock>);

}  // namespace penduline::sim
