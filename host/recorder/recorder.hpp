// SPDX-License-Identifier: Apache-2.0
// Recording beside the sampling: in a thread of its own, through full and slow disks.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <tl/expected.hpp>
#include <vector>

#include "common/sample.hpp"
#include "hal/error.hpp"
#include "hal/replay/recording_event.hpp"
#include "hal/replay/recording_format.hpp"
#include "host/recorder/recording_queue.hpp"
#include "host/recorder/recording_series.hpp"

namespace penduline {

struct RecorderSettings {
  SeriesSettings series;
  /// How often what was written is brought to the disk; none: when the system does so.
  std::optional<std::chrono::milliseconds> sync_period{};
  RecordingQueue::WhenFull when_full = RecordingQueue::WhenFull::kLose;
  /// What may wait for the disk: three minutes at 1 kHz, two hours at 20 Hz.
  std::size_t queue_bytes = std::size_t{16} * 1024 * 1024;
  /// How long to wait before writing again to a disk that took nothing.
  std::chrono::milliseconds retry_period{1000};
};

/// What became of a recording.
struct RecorderReport {
  std::string name;  ///< of the last file
  std::size_t files = 0;
  std::uint64_t samples = 0;     ///< that were recorded
  std::uint64_t lost = 0;        ///< that were not
  std::optional<Error> error{};  ///< why the recording ended early

  /// In words: "recorded 463 samples in rec.csv", "... in 3 files up to rec-0003.csv, lost 5".
  [[nodiscard]] std::string text() const;
};

/// Takes samples and events in order and records them as a RecordingSeries.
class Recorder {
 public:
  /// Begins the first file and the thread. `settings.series.warn` is called from that thread, when
  /// the recording stops for want of room or the like, when it goes on, and when samples are lost.
  static tl::expected<std::unique_ptr<Recorder>, Error> start(RecorderSettings settings,
                                                              const RecordingHeader& header);
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;
  ~Recorder();

  /// Each returns at once but with WhenFull::kWait; then it waits for room, and fails where the
  /// disk does. May be called from any thread.
  tl::expected<void, Error> record(const Sample& sample);
  tl::expected<void, Error> record(RecordingEvent event);
  /// See RecordingSeries::go_on_with. The first sample after a restart must go to the estimator
  /// with the flag `restarted`, as a replay will have it.
  tl::expected<void, Error> go_on_with(const RecordingHeader& header,
                                       std::optional<std::int64_t> utc_us);

  /// Records what waits, ends the thread and tells the outcome; the same one when called again. A
  /// disk that takes nothing gets one more try.
  const RecorderReport& finish();

  /// Of the first file: its path, or "standard output".
  [[nodiscard]] const std::string& name() const { return name_; }
  /// The same of the present file. Of any thread.
  [[nodiscard]] std::string present_name() const;

 private:
  Recorder(RecorderSettings settings, RecordingSeries series);
  void run();
  /// False where the recording has ended early.
  bool record_all(const std::vector<RecordingEntry>& entries);
  tl::expected<void, Error> add(const RecordingEntry& entry);
  /// Tries until the disk takes it; false where there is no waiting any more.
  template <class Work>
  bool insist(const Work& work);
  void give_up(const Error& error);
  void tell_outage(const Error& error);
  void tell_end_of_outage();
  void tell_losses();
  void sync_if_due();

  RecorderSettings settings_;
  RecordingSeries series_;
  const std::string name_;
  mutable std::mutex present_mutex_;
  std::string present_name_;
  RecordingQueue queue_;
  std::uint64_t added_ = 0;  ///< samples
  bool outage_ = false;
  std::chrono::steady_clock::time_point last_failure_;
  std::uint64_t lost_before_outage_ = 0;
  bool losses_told_ = false;
  std::optional<std::chrono::steady_clock::time_point> sync_due_;
  RecorderReport report_;
  std::thread thread_;
};

}  // namespace penduline
