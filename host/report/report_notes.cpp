// SPDX-License-Identifier: Apache-2.0
// Events wait for the first sample of their start.
#include "host/report/report_notes.hpp"

#include "host/web/live_json.hpp"

namespace penduline {

void ReportNotes::take(const RecordingEvent& event, const RecordedTime& time) {
  if (event.kind == event::kPong) {
    return;
  }
  const auto moment_s = time.moment_s(event);
  if (!moment_s) {
    waiting_.push_back(notes_.size());
  }
  notes_.push_back({.event = event, .t_s = moment_s.value_or(time.latest_s())});
}

void ReportNotes::began(const RecordedTime& time) {
  for (const std::size_t i : waiting_) {
    notes_[i].t_s = time.moment_s(notes_[i].event).value_or(notes_[i].t_s);
  }
  waiting_.clear();
}

std::vector<std::string> ReportNotes::json() const {
  std::vector<std::string> texts;
  texts.reserve(notes_.size());
  for (const Note& note : notes_) {
    texts.push_back(note_json(note.event, note.t_s));
  }
  return texts;
}

}  // namespace penduline
