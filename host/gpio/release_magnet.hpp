// SPDX-License-Identifier: Apache-2.0
// The magnet that holds the pendulum, and lets it go at a moment that is known.
#pragma once

#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <tl/expected.hpp>

#include "hal/linux/gpio.hpp"
#include "hal/linux/host_time.hpp"

namespace penduline {

class ReleaseMagnet {
 public:
  using Clock = std::chrono::steady_clock;

  /// `line` is active, so that the magnet holds; it lets go so long after `begin`, by a thread of
  /// its own, which waits for nothing else.
  ReleaseMagnet(std::unique_ptr<GpioOutput> line, Clock::duration delay);
  ReleaseMagnet(const ReleaseMagnet&) = delete;
  ReleaseMagnet& operator=(const ReleaseMagnet&) = delete;
  /// Lets go.
  ~ReleaseMagnet();

  /// Starts the time; does nothing when called again.
  void begin(Clock::time_point now);

  /// The moment that it has let go, or why it could not; once, and none before.
  std::optional<tl::expected<HostTime, Error>> take_release();

 private:
  void run(Clock::time_point deadline);

  std::unique_ptr<GpioOutput> line_;
  const Clock::duration delay_;
  std::mutex mutex_;
  std::condition_variable ending_;
  bool ended_ = false;
  std::optional<tl::expected<HostTime, Error>> release_;
  std::thread thread_;
};

}  // namespace penduline
