// SPDX-License-Identifier: Apache-2.0
// A recording as it is handed out, also while it is being written: whole lines only.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <tl/expected.hpp>

#include "hal/error.hpp"

namespace penduline {

/// The lines that a file has when it is opened. Opening it reads 64 KiB at most, and each `read` as
/// much as it is asked for: a thread that serves others, too, waits for the disk no longer than
/// that.
class RecordingDownload {
 public:
  /// Fails, naming the file, where it cannot be read, or no line ends in its last 64 KiB.
  static tl::expected<RecordingDownload, Error> open(const std::string& path);
  RecordingDownload(const RecordingDownload&) = delete;
  RecordingDownload(RecordingDownload&& other) noexcept;
  RecordingDownload& operator=(const RecordingDownload&) = delete;
  RecordingDownload& operator=(RecordingDownload&&) = delete;
  ~RecordingDownload();

  /// With the last newline.
  [[nodiscard]] std::uint64_t size_bytes() const { return size_; }
  /// Reads on into `bytes`; how many, 0 at the end or where the file no longer gives any.
  std::size_t read(std::span<char> bytes);

 private:
  explicit RecordingDownload(int file) : file_(file) {}

  int file_;
  std::uint64_t size_ = 0;
  std::uint64_t read_ = 0;
};

/// A path's last part, of which nothing is left that could mean something in a header.
[[nodiscard]] std::string download_name(const std::string& path);

}  // namespace penduline
