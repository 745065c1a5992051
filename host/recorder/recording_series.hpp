// SPDX-License-Identifier: Apache-2.0
// The recordings of one run, one file after the other: when a new one begins and what it is called.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <system_error>
#include <tl/expected.hpp>
#include <utility>

#include "common/sample.hpp"
#include "hal/error.hpp"
#include "hal/linux/host_time.hpp"
#include "hal/replay/recording_event.hpp"
#include "hal/replay/recording_format.hpp"
#include "host/recorder/recording_file.hpp"

namespace penduline {

/// How large a file may grow; a file has one row at least.
struct RecordingLimits {
  std::optional<std::uint64_t> bytes{};
  std::optional<std::int64_t> duration_us{};  ///< by the samples' own times

  [[nodiscard]] bool any() const { return bytes || duration_us; }
};

struct SeriesSettings {
  /// "-", a device, or what the files are called. A `%` is strftime's, in UTC. Without one the
  /// files are numbered if there are limits. A name that is taken gets a number: no file is ever
  /// overwritten.
  std::string path;
  RecordingLimits limits{};
  bool durable = false;     ///< a file is on the disk when it has begun, and when it has ended
  bool tell_start = false;  ///< each header says when its file began
  /// Told, in words, what went wrong and stops nothing.
  std::function<void(const std::string&)> warn;
  std::function<std::int64_t()> utc_now_us = [] { return host_time_now().utc_us; };
};

class RecordingSeries {
 public:
  /// Begins the first file. Fails, naming it, where it cannot be created.
  static tl::expected<RecordingSeries, Error> start(SeriesSettings settings,
                                                    RecordingHeader header);

  /// Each adds to the file, beginning another one where that is due, and writes now and then. What
  /// fails has added nothing and may be tried again.
  tl::expected<void, Error> add(const Sample& sample);
  tl::expected<void, Error> add(const RecordingEvent& event);
  /// What the board says of itself after it came back. Another board, or one that samples
  /// otherwise, begins another file; one that has started anew gives a `boot` event with `utc_us`.
  tl::expected<void, Error> go_on_with(const RecordingHeader& header,
                                       std::optional<std::int64_t> utc_us);
  /// Writes all that was added. What fails may be tried again.
  tl::expected<void, Error> write();
  /// Waits until what was written is on the disk; warns, once, where that fails.
  void sync();

  /// Of the present file: its path, or "standard output".
  [[nodiscard]] std::string name() const;
  [[nodiscard]] std::size_t files() const { return files_; }
  /// Samples that were added and are not written.
  [[nodiscard]] std::uint64_t unwritten_samples() const;

 private:
  RecordingSeries(SeriesSettings settings, RecordingHeader header)
      : settings_(std::move(settings)), header_(std::move(header)) {}
  /// Creates the next file under the first name that is free, and tells it in `path`.
  tl::expected<RecordingFile, std::error_code> create_next(std::string& path) const;
  /// Goes over to the next file, which begins at `path`.
  std::error_code begin_next(std::string& path);
  tl::expected<void, Error> divide_if_due(const Sample& sample);
  tl::expected<void, Error> add_line(std::string_view line);
  void warn_of_sync(std::error_code failed);

  SeriesSettings settings_;
  RecordingHeader header_;
  std::optional<RecordingFile> file_;
  std::string path_;
  std::size_t files_ = 0;
  std::string row_;
  bool has_rows_ = false;        ///< of the present file
  std::uint64_t bytes_due_ = 0;  ///< size at which the present file ends
  std::int64_t begin_us_ = 0;    ///< device time at which it began
  std::int64_t last_t_us_ = 0;
  bool sync_failed_ = false;
};

}  // namespace penduline
