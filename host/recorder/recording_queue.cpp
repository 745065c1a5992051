// SPDX-License-Identifier: Apache-2.0
// Handing entries from thread to thread, whole batches at a time.
#include "host/recorder/recording_queue.hpp"

#include <algorithm>
#include <string>
#include <utility>

namespace penduline {
namespace {

/// Waking a thread takes longer than simulating a sample.
constexpr std::size_t kWorthWakingInSimulations = 1024;

bool is_sample(const RecordingEntry& entry) {
  return std::holds_alternative<Sample>(entry);
}

}  // namespace

RecordingQueue::RecordingQueue(std::size_t capacity, WhenFull when_full)
    : capacity_(std::max(capacity, std::size_t{1})),
      when_full_(when_full),
      worth_waking_(when_full == WhenFull::kWait
                        ? std::clamp(capacity_ / 2, std::size_t{1}, kWorthWakingInSimulations)
                        : 1) {}

tl::expected<void, Error> RecordingQueue::put(RecordingEntry entry) {
  std::unique_lock lock(mutex_);
  const auto full = [&] { return entries_.size() + being_recorded_ >= capacity_; };
  if (when_full_ == WhenFull::kWait) {
    if (full()) {
      filled_.notify_one();
      emptied_.wait(lock, [&] { return !full() || abandoned_; });
    }
  } else if (full() && (is_sample(entry) || entries_.size() >= 2 * capacity_)) {
    lose(entry);
    return {};
  }
  if (abandoned_) {
    return tl::unexpected(*abandoned_);
  }
  mark_losses();
  entries_.push_back(std::move(entry));
  if (entries_.size() >= worth_waking_) {
    filled_.notify_one();
  }
  return {};
}

void RecordingQueue::lose(const RecordingEntry& entry) {
  if (is_sample(entry)) {
    ++lost_;
    ++unmarked_.samples;
  } else {
    ++unmarked_.events;
  }
}

void RecordingQueue::mark_losses() {
  if (unmarked_.samples == 0 && unmarked_.events == 0) {
    return;
  }
  RecordingEvent event{.kind = std::string(event::kUnrecorded),
                       .fields = {{"samples", unmarked_.samples}}};
  if (unmarked_.events > 0) {
    event.fields.push_back({"events", unmarked_.events});
  }
  entries_.emplace_back(std::move(event));
  unmarked_ = {};
}

void RecordingQueue::close() {
  const std::lock_guard lock(mutex_);
  // What was lost at the very end is told, too.
  mark_losses();
  closed_ = true;
  filled_.notify_all();
}

bool RecordingQueue::take(std::vector<RecordingEntry>& entries,
                          std::chrono::steady_clock::time_point moment) {
  entries.clear();
  std::unique_lock lock(mutex_);
  being_recorded_ = 0;
  emptied_.notify_all();
  filled_.wait_until(lock, moment, [&] { return entries_.size() >= worth_waking_ || closed_; });
  entries.swap(entries_);
  being_recorded_ = entries.size();
  return !entries.empty() || !closed_;
}

bool RecordingQueue::wait_for_close(std::chrono::milliseconds duration) {
  std::unique_lock lock(mutex_);
  return filled_.wait_for(lock, duration, [&] { return closed_; });
}

std::uint64_t RecordingQueue::abandon(Error reason) {
  const std::lock_guard lock(mutex_);
  const auto samples = std::ranges::count_if(entries_, is_sample);
  entries_.clear();
  abandoned_ = std::move(reason);
  emptied_.notify_all();
  return static_cast<std::uint64_t>(samples);
}

bool RecordingQueue::empty() const {
  const std::lock_guard lock(mutex_);
  return entries_.empty();
}

std::uint64_t RecordingQueue::lost() const {
  const std::lock_guard lock(mutex_);
  return lost_;
}

}  // namespace penduline
