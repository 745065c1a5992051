// SPDX-License-Identifier: Apache-2.0
// Creating a recording in one step, appending to it in steps that cannot be cut.
#include "host/recorder/recording_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <filesystem>
#include <utility>

namespace penduline {
namespace {

/// The least size of a page that Linux knows; larger ones are multiples of it.
constexpr std::size_t kPageBytes = 4096;
constexpr int kNoFile = -1;
constexpr int kRecordingMode = 0644;

std::error_code last_error() {
  return {errno, std::generic_category()};
}

std::string folder_of(const std::string& path) {
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  return folder.empty() ? "." : folder.string();
}

/// A line that readers skip, of so many bytes with its newline.
std::string filler(std::size_t bytes) {
  std::string line(bytes, ' ');
  line.front() = '#';
  line.back() = '\n';
  return line;
}

}  // namespace

tl::expected<RecordingFile, std::error_code> RecordingFile::create(const std::string& path,
                                                                   std::string_view head) {
  struct stat status {};
  const bool standard_output = path == "-";
  if (!standard_output && (::stat(path.c_str(), &status) != 0 || S_ISREG(status.st_mode))) {
    return create_regular(path, head);
  }
  const int file = standard_output
                       ? ::fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, STDERR_FILENO + 1)
                       : ::open(path.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC | O_NOCTTY);
  if (file < 0) {
    return tl::unexpected(last_error());
  }
  RecordingFile stream(file, false);
  std::size_t written = 0;
  if (const auto failed = stream.write_all(head, written)) {
    return tl::unexpected(failed);
  }
  return stream;
}

tl::expected<RecordingFile, std::error_code> RecordingFile::create_regular(const std::string& path,
                                                                           std::string_view head) {
  constexpr int kMode = O_WRONLY | O_APPEND | O_CLOEXEC;
  // Without a name at first; where the file system cannot do that, with it.
  int file = ::open(folder_of(path).c_str(), kMode | O_TMPFILE, kRecordingMode);
  const bool nameless = file >= 0;
  if (!nameless && (errno == EOPNOTSUPP || errno == EISDIR || errno == EINVAL)) {
    file = ::open(path.c_str(), kMode | O_CREAT | O_EXCL, kRecordingMode);
  }
  if (file < 0) {
    return tl::unexpected(last_error());
  }
  RecordingFile recording(file, true);
  std::size_t written = 0;
  std::error_code failed = recording.write_all(head, written);
  if (!failed && nameless &&
      ::linkat(AT_FDCWD, fmt::format("/proc/self/fd/{}", file).c_str(), AT_FDCWD, path.c_str(),
               AT_SYMLINK_FOLLOW) != 0) {
    failed = last_error();
  }
  if (failed) {
    if (!nameless) {
      ::unlink(path.c_str());
    }
    return tl::unexpected(failed);
  }
  recording.written_bytes_ = head.size();
  return recording;
}

RecordingFile::RecordingFile(RecordingFile&& other) noexcept
    : file_(std::exchange(other.file_, kNoFile)),
      regular_(other.regular_),
      torn_(other.torn_),
      written_bytes_(other.written_bytes_),
      text_(std::move(other.text_)),
      begin_(other.begin_) {}

RecordingFile& RecordingFile::operator=(RecordingFile&& other) noexcept {
  std::swap(file_, other.file_);
  std::swap(regular_, other.regular_);
  std::swap(torn_, other.torn_);
  std::swap(written_bytes_, other.written_bytes_);
  std::swap(text_, other.text_);
  std::swap(begin_, other.begin_);
  return *this;
}

RecordingFile::~RecordingFile() {
  if (file_ != kNoFile) {
    ::close(file_);
  }
}

void RecordingFile::add(std::string_view line) {
  assert(line.size() <= kPageBytes && line.ends_with('\n'));
  const std::size_t room = kPageBytes - size_bytes() % kPageBytes;
  if (regular_ && line.size() > room) {
    text_ += filler(room);
  }
  text_ += line;
}

std::error_code RecordingFile::write_all(std::string_view text, std::size_t& written) const {
  while (written < text.size()) {
    const ssize_t more = ::write(file_, text.data() + written, text.size() - written);
    if (more < 0 && errno != EINTR) {
      return last_error();
    }
    written += more < 0 ? 0 : static_cast<std::size_t>(more);
  }
  return {};
}

std::error_code RecordingFile::write() {
  const auto shorten = [this] {
    torn_ = ::ftruncate(file_, static_cast<off_t>(written_bytes_)) != 0;
    return !torn_;
  };
  if (torn_ && !shorten()) {
    return last_error();
  }
  while (!waiting().empty()) {
    const std::size_t room = kPageBytes - written_bytes_ % kPageBytes;
    const std::string_view page = waiting().substr(0, room);
    std::size_t written = 0;
    const std::error_code failed = write_all(page, written);
    const std::size_t whole =
        regular_ && failed ? page.substr(0, written).rfind('\n') + 1 : written;
    written_bytes_ += whole;
    begin_ += whole;
    if (failed) {
      if (written > whole) {
        shorten();
      }
      return failed;
    }
  }
  text_.clear();
  begin_ = 0;
  return {};
}

std::error_code RecordingFile::sync() const {
  return regular_ && ::fdatasync(file_) != 0 ? last_error() : std::error_code();
}

std::error_code RecordingFile::sync_with_name(const std::string& path) const {
  if (!regular_) {
    return {};
  }
  const int folder = ::open(folder_of(path).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder < 0) {
    return last_error();
  }
  const bool done = ::fsync(file_) == 0 && ::fsync(folder) == 0;
  const std::error_code outcome = done ? std::error_code() : last_error();
  ::close(folder);
  return outcome;
}

}  // namespace penduline
