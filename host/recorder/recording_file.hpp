// SPDX-License-Identifier: Apache-2.0
// One recording on disk that grows by whole lines, whatever ends the program or fills the disk.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <system_error>
#include <tl/expected.hpp>

namespace penduline {

/// A file that never holds a part of a line, but while the disk refuses even to shorten it.
///
/// A kill -9 cuts a write where a page of memory ends. So no line crosses a page: comments of
/// blanks fill the pages up, and no call writes beyond one.
class RecordingFile {
 public:
  /// Creates a file with `head` in it, which appears in its folder with the whole head or not at
  /// all. Fails with errc::file_exists where the name is taken. The path "-" is the standard
  /// output; a device or a pipe is opened as it is.
  static tl::expected<RecordingFile, std::error_code> create(const std::string& path,
                                                             std::string_view head);

  RecordingFile(const RecordingFile&) = delete;
  RecordingFile(RecordingFile&& other) noexcept;
  RecordingFile& operator=(const RecordingFile&) = delete;
  RecordingFile& operator=(RecordingFile&& other) noexcept;
  ~RecordingFile();

  /// Adds a line with its newline, of a page (4096 bytes) at most. It waits for `write`.
  void add(std::string_view line);
  /// Writes what waits. After an error whole lines of it are in the file and the others wait on.
  std::error_code write();
  /// Waits until what was written is on the disk.
  std::error_code sync() const;
  /// The same for the name of a file that was just created at `path`.
  std::error_code sync_with_name(const std::string& path) const;

  /// A file, and no device or pipe.
  [[nodiscard]] bool regular() const { return regular_; }
  /// With what waits.
  [[nodiscard]] std::uint64_t size_bytes() const { return written_bytes_ + waiting().size(); }
  /// What is not yet written.
  [[nodiscard]] std::string_view waiting() const { return std::string_view(text_).substr(begin_); }

 private:
  RecordingFile(int file, bool regular) : file_(file), regular_(regular) {}
  static tl::expected<RecordingFile, std::error_code> create_regular(const std::string& path,
                                                                     std::string_view head);
  /// Writes the start of what waits; `written` says how much of it, also after an error.
  std::error_code write_all(std::string_view text, std::size_t& written) const;

  int file_;
  bool regular_;
  bool torn_ = false;  ///< there may be a part of a line behind `written_bytes_`
  std::uint64_t written_bytes_ = 0;
  std::string text_;
  std::size_t begin_ = 0;  ///< of what waits in `text_`
};

}  // namespace penduline
