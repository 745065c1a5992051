// SPDX-License-Identifier: Apache-2.0
// When something was, in the time of a recording's report.
#pragma once

#include <cstdint>
#include <optional>

#include "common/sample.hpp"
#include "hal/replay/recording_event.hpp"
#include "host/web/session_time.hpp"

namespace penduline {

/// Follows samples and events in the order of the recording. Where the board started anew, the
/// events' host's time says how long that took.
class RecordedTime {
 public:
  /// Takes the next sample; returns the host's time of it in microseconds, as far as events told.
  std::int64_t follow(const Sample& sample);
  void follow(const RecordingEvent& event);

  /// Of the newest sample, in seconds since the first; 0 before it.
  [[nodiscard]] double latest_s() const { return time_.at_board_s(latest_t_us_.value_or(0)); }
  /// Of an event that comes next: by the board's clock where it says that, else by the host's, else
  /// that of the newest sample. None while no sample has come of the start that the event's t_us
  /// belongs to.
  [[nodiscard]] std::optional<double> moment_s(const RecordingEvent& event) const;

 private:
  SessionTime time_;
  bool starts_ = true;  ///< no sample has come since the board's start
  std::optional<std::int64_t> latest_t_us_;
  std::optional<std::int64_t> event_host_us_;  ///< host's time of the latest event
  std::optional<std::int64_t> event_t_us_;     ///< board's time then; none: it starts anew
};

}  // namespace penduline
