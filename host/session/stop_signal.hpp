// SPDX-License-Identifier: Apache-2.0
// Ctrl-C, SIGTERM and a terminal that is gone as a request to stop cleanly.
#pragma once

#include <chrono>
#include <csignal>

namespace penduline {

/// While it lives, the first SIGINT, SIGTERM or SIGHUP is only noted; a second one kills the
/// program. One that the program was started to ignore, as by nohup, is ignored.
class StopSignal {
 public:
  StopSignal();
  StopSignal(const StopSignal&) = delete;
  StopSignal& operator=(const StopSignal&) = delete;
  ~StopSignal();

  [[nodiscard]] bool requested() const;
  /// Sleeps until the moment or until a stop is requested.
  void sleep_until(std::chrono::steady_clock::time_point moment) const;

 private:
  struct sigaction interrupt_before_ {};
  struct sigaction terminate_before_ {};
  struct sigaction hang_up_before_ {};
};

}  // namespace penduline
