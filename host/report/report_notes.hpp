// SPDX-License-Identifier: Apache-2.0
// A recording's events as its report tells them, each at its own time.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hal/replay/recording_event.hpp"
#include "host/report/recorded_time.hpp"

namespace penduline {

/// All events but those of clocks.
class ReportNotes {
 public:
  /// `time` has not yet followed the event.
  void take(const RecordingEvent& event, const RecordedTime& time);
  /// To be called after each sample: events that came before the first one of their start now have
  /// their time.
  void began(const RecordedTime& time);

  /// Each as docs/web_protocol.md has it.
  [[nodiscard]] std::vector<std::string> json() const;

 private:
  struct Note {
    RecordingEvent event;
    double t_s = 0;
  };

  std::vector<Note> notes_;
  std::vector<std::size_t> waiting_;  ///< notes whose time is not known yet
};

}  // namespace penduline
