// SPDX-License-Identifier: Apache-2.0
// Reading lines through one buffer that never grows.
#include "hal/replay/line_reader.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

namespace penduline {
namespace {

constexpr std::size_t kBufferBytes = std::size_t{256} * 1024;
constexpr int kClosed = -1;

}  // namespace

tl::expected<LineReader, Error> LineReader::open(const std::string& path) {
  if (path == "-") {
    return LineReader("standard input", STDIN_FILENO, 0);
  }
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) {
    return failure(fmt::format("{}: {}", path, std::strerror(errno)));
  }
  struct stat status {};
  const bool regular = ::fstat(file, &status) == 0 && S_ISREG(status.st_mode);
  return LineReader(path, file, regular ? static_cast<std::uint64_t>(status.st_size) : 0);
}

LineReader::LineReader(std::string name, int file, std::uint64_t size_bytes)
    : name_(std::move(name)), file_(file), size_bytes_(size_bytes), buffer_(kBufferBytes) {}

LineReader::LineReader(LineReader&& other) noexcept
    : name_(std::move(other.name_)),
      file_(std::exchange(other.file_, kClosed)),
      size_bytes_(other.size_bytes_),
      consumed_bytes_(other.consumed_bytes_),
      buffer_(std::move(other.buffer_)),
      begin_(other.begin_),
      end_(other.end_),
      line_(other.line_),
      line_number_(other.line_number_) {}

LineReader::~LineReader() {
  if (file_ > STDIN_FILENO) {
    ::close(file_);
  }
}

tl::expected<bool, Error> LineReader::fill() {
  std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
  end_ -= begin_;
  begin_ = 0;
  const ssize_t got = ::read(file_, buffer_.data() + end_, buffer_.size() - end_);
  if (got < 0 && errno == EINTR) {
    return false;  // only a request to stop interrupts us
  }
  if (got < 0) {
    return failure(fmt::format("{}: {}", name_, std::strerror(errno)));
  }
  end_ += static_cast<std::size_t>(got);
  return got > 0;
}

tl::expected<LineReader::Outcome, Error> LineReader::next() {
  std::size_t searched = 0;
  Outcome outcome = Outcome::kLine;
  const char* newline = nullptr;
  while (newline == nullptr) {
    const std::string_view unread(buffer_.data() + begin_, end_ - begin_);
    newline = static_cast<const char*>(
        std::memchr(unread.data() + searched, '\n', unread.size() - searched));
    if (newline != nullptr) {
      line_ = unread.substr(0, static_cast<std::size_t>(newline - unread.data()));
      break;
    }
    searched = unread.size();
    if (searched > kMaxLineBytes) {
      line_ = unread;
      break;
    }
    const auto more = fill();
    if (!more) {
      return tl::unexpected(more.error());
    }
    if (!*more) {
      line_ = std::string_view(buffer_.data() + begin_, end_ - begin_);
      if (line_.empty()) {
        return Outcome::kEndOfFile;
      }
      outcome = Outcome::kCutShort;
      break;
    }
  }
  ++line_number_;
  if (line_.size() > kMaxLineBytes) {
    return failure(fmt::format("{}: the line is longer than {} bytes; is this the right file?",
                               place(), kMaxLineBytes));
  }
  if (std::ranges::find(line_, '\0') != line_.end()) {
    return failure(
        fmt::format("{}: found a NUL byte, expected text; is this the right file?", place()));
  }
  const std::size_t used = line_.size() + (newline != nullptr ? 1 : 0);
  begin_ += used;
  consumed_bytes_ += used;
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
  if (line_number_ == 1 && line_.starts_with(kByteOrderMark)) {
    line_.remove_prefix(kByteOrderMark.size());
  }
  if (line_.ends_with('\r')) {
    line_.remove_suffix(1);
  }
  return outcome;
}

std::string LineReader::place() const {
  return fmt::format("{}:{}", name_, line_number_);
}

double LineReader::progress() const {
  return size_bytes_ == 0 ? 0
                          : std::min(1.0, static_cast<double>(consumed_bytes_) /
                                              static_cast<double>(size_bytes_));
}

tl::expected<std::string, Error> read_whole_text(const std::string& path) {
  auto lines = LineReader::open(path);
  if (!lines) {
    return tl::unexpected(lines.error());
  }
  std::string text;
  while (true) {
    const auto outcome = lines->next();
    if (!outcome) {
      return tl::unexpected(outcome.error());
    }
    if (*outcome == LineReader::Outcome::kEndOfFile) {
      return text;
    }
    text += lines->line();
    text += '\n';
  }
}

}  // namespace penduline
