// SPDX-License-Identifier: Apache-2.0
// Reads a text file line by line in constant memory, naming the place of whatever is wrong.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <vector>

#include "hal/error.hpp"

namespace penduline {

/// The longest line that a recording may have, in bytes.
inline constexpr std::size_t kMaxLineBytes = 4096;

/// Lines of a file or, for the path "-", of the standard input.
class LineReader {
 public:
  /// Fails where the file cannot be opened.
  static tl::expected<LineReader, Error> open(const std::string& path);

  LineReader(const LineReader&) = delete;
  LineReader(LineReader&& other) noexcept;
  LineReader& operator=(const LineReader&) = delete;
  LineReader& operator=(LineReader&&) = delete;
  ~LineReader();

  enum class Outcome {
    kLine,       ///< `line()` is a whole line
    kCutShort,   ///< `line()` is the rest of a file that does not end with a newline
    kEndOfFile,  ///< nothing left
  };

  /// Goes to the next line. Fails on a line over kMaxLineBytes, on a NUL byte (a binary file) and
  /// where reading itself fails. A signal that interrupts a wait for input ends the file.
  tl::expected<Outcome, Error> next();

  /// The current line without its end (LF or CRLF) and the file's byte order mark; valid until the
  /// next call of `next`.
  [[nodiscard]] std::string_view line() const { return line_; }
  /// The current line's number, from 1.
  [[nodiscard]] std::uint64_t line_number() const { return line_number_; }
  /// "FILE:LINE" of the current line.
  [[nodiscard]] std::string place() const;
  [[nodiscard]] const std::string& name() const { return name_; }
  /// How much of the file has been read, in 0..1; 0 where its size is unknown.
  [[nodiscard]] double progress() const;

 private:
  LineReader(std::string name, int file, std::uint64_t size_bytes);
  /// Reads more into the buffer behind what is not yet used; false at the end of the file.
  tl::expected<bool, Error> fill();

  std::string name_;
  int file_;
  std::uint64_t size_bytes_;
  std::uint64_t consumed_bytes_ = 0;
  std::vector<char> buffer_;
  std::size_t begin_ = 0;
  std::size_t end_ = 0;
  std::string_view line_;
  std::uint64_t line_number_ = 0;
};

/// All lines of a file, each ended by LF. Fails where `LineReader` does.
[[nodiscard]] tl::expected<std::string, Error> read_whole_text(const std::string& path);

}  // namespace penduline
