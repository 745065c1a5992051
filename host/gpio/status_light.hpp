// SPDX-License-Identifier: Apache-2.0
// The light that says that samples come.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "hal/linux/gpio.hpp"

namespace penduline {

class StatusLight {
 public:
  using Clock = std::chrono::steady_clock;

  /// `line` is dark. `warn` is told, once, where it cannot be switched.
  StatusLight(std::unique_ptr<GpioOutput> line, std::function<void(const std::string&)> warn);

  /// Lit from a sample on; dark when the board has gone, and when nothing came for a second and
  /// twice the time between the last two samples.
  void turn(bool sample, bool connected, Clock::time_point now);

 private:
  void set(bool lit);

  std::unique_ptr<GpioOutput> line_;
  std::function<void(const std::string&)> warn_;
  bool lit_ = false;
  bool warned_ = false;
  std::optional<Clock::time_point> sample_at_;  ///< the last one of this connection
  Clock::duration interval_{};
};

}  // namespace penduline
