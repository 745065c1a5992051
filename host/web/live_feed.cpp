// SPDX-License-Identifier: Apache-2.0
// Two sets of news that change places.
#include "host/web/live_feed.hpp"

#include <algorithm>
#include <utility>

#include "hal/linux/host_time.hpp"

namespace penduline {

LiveFeed::LiveFeed(std::size_t most_samples, std::size_t most_notes)
    : most_samples_(most_samples), most_notes_(most_notes) {}

void LiveFeed::take(const Estimate<double>& estimate) {
  const LiveSample sample{
      .sample = newest_, .estimate = estimate, .host_us = host_time_now().monotonic_us};
  const std::lock_guard lock(mutex_);
  if (news_.samples.size() < most_samples_) {
    news_.samples.push_back(sample);
    return;
  }
  news_.samples[oldest_] = sample;
  oldest_ = (oldest_ + 1) % most_samples_;
}

void LiveFeed::note(RecordingEvent event) {
  const std::int64_t now_us = host_time_now().monotonic_us;
  const std::lock_guard lock(mutex_);
  if (news_.notes.size() < most_notes_) {
    news_.notes.push_back({.event = std::move(event), .host_us = now_us});
  }
}

void LiveFeed::tell(const RecordingHeader& header) {
  const std::lock_guard lock(mutex_);
  news_.header = header;
}

void LiveFeed::tell(const DeviceClock& clock) {
  const std::lock_guard lock(mutex_);
  news_.clock = clock;
}

void LiveFeed::tell(const Summary& counts) {
  const std::lock_guard lock(mutex_);
  news_.counts = counts;
}

void LiveFeed::collect(LiveNews& news) {
  news.samples.clear();
  news.notes.clear();
  news.header.reset();
  news.clock.reset();
  news.counts.reset();
  std::size_t oldest = 0;
  {
    const std::lock_guard lock(mutex_);
    std::swap(news, news_);
    oldest = std::exchange(oldest_, 0);
  }
  std::rotate(news.samples.begin(), news.samples.begin() + static_cast<std::ptrdiff_t>(oldest),
              news.samples.end());
}

}  // namespace penduline
