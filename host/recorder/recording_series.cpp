// SPDX-License-Identifier: Apache-2.0
// Going from one file of a series to the next.
#include "host/recorder/recording_series.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <utility>

#include "hal/replay/utc_text.hpp"
#include "host/recorder/recording_name.hpp"

namespace penduline {
namespace {

constexpr std::size_t kWorthWritingBytes = std::size_t{64} * 1024;

std::string shown(const std::string& path) {
  return path == "-" ? "standard output" : path;
}

/// The standard output, a device or a pipe.
bool is_stream(const std::string& path) {
  std::error_code failed;
  return path == "-" ||
         (std::filesystem::exists(path, failed) && !std::filesystem::is_regular_file(path, failed));
}

tl::unexpected<Error> failed_at(const std::string& path, std::error_code reason) {
  return failure(fmt::format("{}: {}", shown(path), reason.message()));
}

/// Whether a file could not be created for want of room, which may come back.
bool is_want_of_room(std::error_code reason) {
  return reason == std::errc::no_space_on_device || reason.value() == EDQUOT;
}

}  // namespace

tl::expected<RecordingSeries, Error> RecordingSeries::start(SeriesSettings settings,
                                                            RecordingHeader header) {
  RecordingSeries series(std::move(settings), std::move(header));
  const std::string& pattern = series.settings_.path;
  if (series.settings_.limits.any() && is_stream(pattern)) {
    return failure(shown(pattern) + ": found no ordinary file, expected one to be divided");
  }
  std::string path;
  if (const auto failed = series.begin_next(path)) {
    return failed_at(path, failed);
  }
  return series;
}

tl::expected<RecordingFile, std::error_code> RecordingSeries::create_next(std::string& path) const {
  const std::int64_t now_us = settings_.utc_now_us();
  RecordingHeader header = header_;
  if (settings_.tell_start) {
    header.started = utc_text_s(now_us);
  }
  const std::string head = recording_head(header);
  const std::string name = dated_name(settings_.path, now_us);
  const bool numbered = settings_.limits.any() && settings_.path.find('%') == std::string::npos;
  path = name;
  if (!numbered) {
    auto file = RecordingFile::create(path, head);
    if (file || file.error() != std::errc::file_exists) {
      return file;
    }
  }
  for (unsigned number = std::max(next_number(name), numbered ? 1U : 2U);; ++number) {
    path = numbered_name(name, number);
    auto file = RecordingFile::create(path, head);
    if (file || file.error() != std::errc::file_exists) {
      return file;
    }
  }
}

std::error_code RecordingSeries::begin_next(std::string& path) {
  auto next = create_next(path);
  if (!next) {
    return next.error();
  }
  if (settings_.durable) {
    if (file_) {
      sync();
    }
    warn_of_sync(next->sync_with_name(path));
  }
  file_ = std::move(*next);
  path_ = path;
  ++files_;
  has_rows_ = false;
  bytes_due_ = settings_.limits.bytes.value_or(0);
  return {};
}

tl::expected<void, Error> RecordingSeries::divide_if_due(const Sample& sample) {
  const auto& [bytes, duration_us] = settings_.limits;
  if (!has_rows_) {
    begin_us_ = sample.t_us;
  } else if (sample.t_us < last_t_us_) {
    begin_us_ += sample.t_us - last_t_us_;  // the board has started anew, its time goes on
  }
  last_t_us_ = sample.t_us;
  const bool due = (bytes && file_->size_bytes() + row_.size() > bytes_due_) ||
                   (duration_us && sample.t_us - begin_us_ >= *duration_us);
  if (!has_rows_ || !due) {
    return {};
  }
  if (auto written = write(); !written) {
    return written;
  }
  std::string path;
  if (const auto failed = begin_next(path)) {
    if (is_want_of_room(failed)) {
      return failed_at(path, failed);
    }
    settings_.warn(fmt::format("{}: {}; recording goes on in {}", path, failed.message(), name()));
    begin_us_ = sample.t_us;
    bytes_due_ = file_->size_bytes() + bytes.value_or(0);
    return {};
  }
  begin_us_ = sample.t_us;
  return {};
}

tl::expected<void, Error> RecordingSeries::add(const Sample& sample) {
  row_.clear();
  append_recording_row(row_, sample, header_.acquisition.sensor_count);
  if (auto ready = divide_if_due(sample); !ready) {
    return ready;
  }
  has_rows_ = true;
  return add_line(row_);
}

tl::expected<void, Error> RecordingSeries::add(const RecordingEvent& event) {
  return add_line(event_line(event));
}

tl::expected<void, Error> RecordingSeries::add_line(std::string_view line) {
  if (file_->waiting().size() >= kWorthWritingBytes) {
    if (auto written = write(); !written) {
      return written;
    }
  }
  file_->add(line);
  return {};
}

tl::expected<void, Error> RecordingSeries::go_on_with(const RecordingHeader& header,
                                                      std::optional<std::int64_t> utc_us) {
  if (header.acquisition == header_.acquisition && header.serial == header_.serial) {
    const bool restarted = header.boot_id != header_.boot_id;
    if (restarted) {
      if (auto added = add(boot_event(header, utc_us)); !added) {
        return added;
      }
    }
    header_ = header;
    return {};
  }
  if (auto written = write(); !written) {
    return written;
  }
  RecordingHeader before = std::exchange(header_, header);
  std::string path;
  if (const auto failed = begin_next(path)) {
    header_ = std::move(before);
    return failed_at(path, failed);
  }
  return {};
}

tl::expected<void, Error> RecordingSeries::write() {
  if (const auto failed = file_->write()) {
    return failed_at(path_, failed);
  }
  return {};
}

void RecordingSeries::sync() {
  warn_of_sync(file_->sync());
}

void RecordingSeries::warn_of_sync(std::error_code failed) {
  if (failed && !std::exchange(sync_failed_, true)) {
    settings_.warn(fmt::format("{}: fsync: {}; what was recorded last may not be on the disk",
                               name(), failed.message()));
  }
}

std::string RecordingSeries::name() const {
  return shown(path_);
}

std::uint64_t RecordingSeries::unwritten_samples() const {
  // Rows begin with a number, events and fillers do not.
  std::uint64_t count = 0;
  bool line_begins = true;
  for (const char c : file_->waiting()) {
    count += line_begins && c >= '0' && c <= '9' ? 1U : 0U;
    line_begins = c == '\n';
  }
  return count;
}

}  // namespace penduline
