// SPDX-License-Identifier: Apache-2.0
// What waits between the sampling, which must not wait, and the disk, which may be slow or full.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <tl/expected.hpp>
#include <variant>
#include <vector>

#include "common/sample.hpp"
#include "hal/error.hpp"
#include "hal/replay/recording_event.hpp"
#include "hal/replay/recording_format.hpp"

namespace penduline {

/// A board that came back, and when.
struct BoardReturn {
  RecordingHeader header;
  std::optional<std::int64_t> utc_us;
};

/// The last one is rare and large.
using RecordingEntry = std::variant<Sample, RecordingEvent, std::unique_ptr<const BoardReturn>>;

/// Entries in order, from any threads to one that records them.
class RecordingQueue {
 public:
  enum class WhenFull {
    kLose,  ///< a sample is lost, counted and marked by an `unrecorded` event; events are kept
    kWait,  ///< the sampling waits: it is a simulation and runs as fast as it can
  };

  RecordingQueue(std::size_t capacity, WhenFull when_full);

  /// Puts an entry at the end. Fails with the error of `abandon`.
  tl::expected<void, Error> put(RecordingEntry entry);
  /// No entry comes any more.
  void close();

  /// Waits until there are entries, the queue is closed or the moment has come, then puts what
  /// there is in place of `entries`, which count as recorded. False when closed and empty.
  bool take(std::vector<RecordingEntry>& entries, std::chrono::steady_clock::time_point moment);
  /// Sleeps for so long, or until the queue is closed: true.
  bool wait_for_close(std::chrono::milliseconds duration);
  /// Takes no entry any more, for this reason; throws those away that wait and says how many
  /// samples they were.
  std::uint64_t abandon(Error reason);

  /// Whether nothing waits to be taken.
  [[nodiscard]] bool empty() const;
  /// Samples lost so far because the queue was full.
  [[nodiscard]] std::uint64_t lost() const;

 private:
  struct Losses {
    std::int64_t samples = 0;
    std::int64_t events = 0;
  };

  /// Counts an entry for which there is no room.
  void lose(const RecordingEntry& entry);
  /// Says in the recording what was lost at this place.
  void mark_losses();

  const std::size_t capacity_;
  const WhenFull when_full_;
  const std::size_t worth_waking_;
  mutable std::mutex mutex_;
  std::condition_variable filled_;
  std::condition_variable emptied_;
  std::vector<RecordingEntry> entries_;
  std::size_t being_recorded_ = 0;
  std::uint64_t lost_ = 0;
  Losses unmarked_;
  bool closed_ = false;
  std::optional<Error> abandoned_;
};

}  // namespace penduline
