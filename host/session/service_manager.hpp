// SPDX-License-Identifier: Apache-2.0
// What the service manager, systemd, is told where it has started the program.
#pragma once

#include <chrono>
#include <optional>
#include <string>

namespace penduline {

/// Speaks by sd_notify(3); without NOTIFY_SOCKET in the environment nothing happens. Of one thread.
class ServiceManager {
 public:
  /// Takes the watchdog's period from the environment.
  ServiceManager();
  ServiceManager(const ServiceManager&) = delete;
  ServiceManager& operator=(const ServiceManager&) = delete;
  /// Stops, if that has not been said.
  ~ServiceManager();

  /// The program is up, and what it does.
  void ready(const std::string& status);
  /// What it does now.
  void tell(const std::string& status);
  /// The loop has turned. Only this keeps the watchdog quiet, so a loop that hangs is seen to.
  void turned();
  /// Whether the last status is old enough for a new count.
  [[nodiscard]] bool count_due() const;
  /// The program ends from now on; the watchdog no longer counts.
  void stopping();

 private:
  using Clock = std::chrono::steady_clock;

  std::optional<Clock::duration> watchdog_period_;
  Clock::time_point turn_told_at_;
  Clock::time_point status_told_at_;
  bool is_up_ = false;
};

}  // namespace penduline
