// SPDX-License-Identifier: Apache-2.0
// Watchdog, light and resets of the simulated board: they note what hardware would do.
#pragma once

#include <cstdint>
#include <optional>

#include "hal/concepts.hpp"
#include "hal/sim/virtual_clock.hpp"

namespace penduline::sim {

class Light {
 public:
  void set(bool lit) { lit_ = lit; }
  [[nodiscard]] bool lit() const { return lit_; }

 private:
  bool lit_ = false;
};

static_assert(Indicator<Light>);

class VirtualWatchdog {
 public:
  static constexpr std::uint64_t kTimeoutUs = 5'000'000;

  explicit VirtualWatchdog(const VirtualClock& clock) : clock_(clock) {}

  void start() { fed_at_us_ = clock_.now_us(); }
  void feed() { start(); }

  [[nodiscard]] bool expired() const {
    return fed_at_us_ && clock_.now_us() - *fed_at_us_ > kTimeoutUs;
  }

 private:
  const VirtualClock& clock_;
  std::optional<std::uint64_t> fed_at_us_;
};

static_assert(Watchdog<VirtualWatchdog>);

/// How a board's life ended.
enum class Ending : std::uint8_t { kWatchdog, kRestart, kBootloader };

class VirtualReset {
 public:
  explicit VirtualReset(wire::ResetCause cause) : cause_(cause) {}

  [[nodiscard]] wire::ResetCause cause() const { return cause_; }
  void restart() { end(Ending::kRestart); }
  void enter_bootloader() { end(Ending::kBootloader); }

  /// Once it has ended the board must not be stepped any more: what runs it makes a new one.
  void end(Ending ending) { ending_ = ending_.value_or(ending); }
  [[nodiscard]] std::optional<Ending> ending() const { return ending_; }

 private:
  wire::ResetCause cause_;
  std::optional<Ending> ending_;
};

static_assert(Reboot<VirtualReset>);

}  // namespace penduline::sim
