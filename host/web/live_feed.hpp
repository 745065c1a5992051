// SPDX-License-Identifier: Apache-2.0
// What the sampling thread leaves for the web server's: always at once, in bounded memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <optional>
#include <vector>

#include "common/estimate.hpp"
#include "common/sample.hpp"
#include "hal/replay/recording_event.hpp"
#include "hal/replay/recording_format.hpp"
#include "host/session/device_clock.hpp"
#include "host/session/summary.hpp"

namespace penduline {

/// A sample, and the estimate that it led to.
struct LiveSample {
  Sample sample;
  Estimate<double> estimate;
  std::int64_t host_us = 0;  ///< CLOCK_MONOTONIC, when it was there
};

/// Something that happened beside the samples.
struct LiveNote {
  RecordingEvent event;
  std::int64_t host_us = 0;  ///< CLOCK_MONOTONIC, when it was told
};

/// All that has come since it was taken the last time.
struct LiveNews {
  std::vector<LiveSample> samples;        ///< in order; the newest ones, where they were too many
  std::vector<LiveNote> notes;            ///< in order
  std::optional<RecordingHeader> header;  ///< of the source, where it was told anew
  std::optional<DeviceClock> clock;       ///< the board's, likewise
  std::optional<Summary> counts;          ///< likewise
};

/// From the session's thread to one other. Whoever puts in waits for nothing but a copy of what is
/// there, and once it has been filled no sample allocates memory.
class LiveFeed {
 public:
  /// Keeps so many samples and notes at most: the oldest sample goes, the newest note.
  explicit LiveFeed(std::size_t most_samples = 4096, std::size_t most_notes = 256);

  /// The sample that the next estimate comes from.
  void take(const Sample& sample) { newest_ = sample; }
  void take(const Estimate<double>& estimate);
  /// Of any thread.
  void note(RecordingEvent event);
  void tell(const RecordingHeader& header);
  void tell(const DeviceClock& clock);
  void tell(const Summary& counts);

  /// Puts what has come in place of `news`, whose memory is used again.
  void collect(LiveNews& news);

 private:
  const std::size_t most_samples_;
  const std::size_t most_notes_;
  Sample newest_;
  std::mutex mutex_;
  LiveNews news_;
  std::size_t oldest_ = 0;  ///< of the samples, once they are too many
};

}  // namespace penduline
