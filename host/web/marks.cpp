// SPDX-License-Identifier: Apache-2.0
// A mark gets its time where it is set, not where it is taken.
#include "host/web/marks.hpp"

#include <utility>

#include "host/session/moment_event.hpp"

namespace penduline {

tl::expected<void, Error> Marks::set(std::string_view text) {
  const HostTime now = host_time_now();
  const std::lock_guard lock(mutex_);
  if (waiting_.size() >= kMostWaiting) {
    return failure("Too many marks at once.");
  }
  waiting_.push_back({.moment = now, .text = mark_text(text)});
  return {};
}

std::vector<RecordingEvent> Marks::take(const std::optional<DeviceClock>& clock) {
  std::vector<Mark> marks;
  {
    const std::lock_guard lock(mutex_);
    marks.swap(waiting_);
  }
  std::vector<RecordingEvent> events;
  for (Mark& mark : marks) {
    RecordingEvent event = moment_event(event::kMark, mark.moment, clock);
    event.fields.push_back({"text", std::move(mark.text)});
    events.push_back(std::move(event));
  }
  return events;
}

std::string mark_text(std::string_view typed) {
  constexpr std::size_t kMostBytes = 200;
  constexpr unsigned char kFirstPrintable = 0x20;
  constexpr unsigned char kDelete = 0x7f;
  const auto continues = [&](std::size_t i) {
    return (static_cast<unsigned char>(typed[i]) & 0xc0U) == 0x80U;
  };
  std::size_t end = typed.size();
  if (end > kMostBytes) {
    end = kMostBytes;
    while (end > 0 && continues(end)) {
      --end;
    }
  }
  std::string text(typed.substr(0, end));
  for (char& c : text) {
    const auto byte = static_cast<unsigned char>(c);
    c = byte < kFirstPrintable || byte == kDelete ? ' ' : c;
  }
  return text;
}

}  // namespace penduline
