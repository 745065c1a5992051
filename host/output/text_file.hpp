// SPDX-License-Identifier: Apache-2.0
// A text file or the standard output, written through one buffer, whole lines at a time.
#pragma once

#include <span>
#include <string>
#include <tl/expected.hpp>

#include "hal/error.hpp"

namespace penduline {

/// Appends text; what is appended between two flushes reaches the file in order and complete, or
/// the flush says why not.
class TextFile {
 public:
  /// Creates or empties the file; the path "-" is the standard output.
  static tl::expected<TextFile, Error> create(const std::string& path);

  TextFile(const TextFile&) = delete;
  TextFile(TextFile&& other) noexcept;
  TextFile& operator=(const TextFile&) = delete;
  TextFile& operator=(TextFile&&) = delete;
  ~TextFile();

  /// Where to append; call `flush_if_large` after each line.
  std::string& text() { return text_; }
  tl::expected<void, Error> flush_if_large();
  tl::expected<void, Error> flush();

  /// Writes some of the text, in one call and no more than a pipe takes whole: where `descriptor`
  /// is ready for it, that does not wait for the reader.
  tl::expected<void, Error> write_piece();
  [[nodiscard]] int descriptor() const { return file_; }
  /// What messages call it.
  [[nodiscard]] const std::string& name() const { return name_; }

 private:
  TextFile(std::string name, int file);

  std::string name_;
  int file_;
  std::string text_;
};

/// Puts a text into a file, which is there whole or not at all: what stood there before stays until
/// all is written.
[[nodiscard]] tl::expected<void, Error> put_file(const std::string& path, const std::string& text);

/// The path of a file to be read, for `require_distinct_files`: "" for the standard input.
[[nodiscard]] inline std::string named_input(const std::string& path) {
  return path == "-" ? "" : path;
}

/// Fails where a file to be read is the standard input, which can be read once only.
[[nodiscard]] tl::expected<void, Error> require_file(const std::string& path);

/// Fails where a file to be written has no folder to stand in: long work says so before it begins.
[[nodiscard]] tl::expected<void, Error> require_folder(const std::string& path);

/// Fails where one path of `paths` stands for a file that another does: what is read would be
/// overwritten, or two texts would mix. "" does not count, devices may stand there twice.
[[nodiscard]] tl::expected<void, Error> require_distinct_files(std::span<const std::string> paths);

}  // namespace penduline
