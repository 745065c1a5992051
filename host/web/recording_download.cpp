// SPDX-License-Identifier: Apache-2.0
// Finding the last newline, and reading up to it.
#include "host/web/recording_download.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <string_view>
#include <utility>
#include <vector>

namespace penduline {
namespace {

constexpr int kNone = -1;

/// Longer than any line of a recording, and soon read.
constexpr std::size_t kMostBehindLine = 65536;

/// Where the last line of the first `size` bytes ends; 0 where they are few and none ends. Fails
/// where no line ends in the last 64 KiB of more, or they cannot be read.
tl::expected<std::uint64_t, Error> end_of_lines(int file, std::uint64_t size) {
  std::vector<char> tail(std::min<std::uint64_t>(size, kMostBehindLine));
  const std::uint64_t begin = size - tail.size();
  const auto got = ::pread(file, tail.data(), tail.size(), static_cast<off_t>(begin));
  if (got < 0) {
    return failure(std::strerror(errno));
  }
  const std::string_view text(tail.data(), static_cast<std::size_t>(got));
  const auto newline = text.rfind('\n');
  if (newline == std::string_view::npos && begin > 0) {
    return failure(fmt::format("found no line that ends in its last {} bytes, expected a recording",
                               kMostBehindLine));
  }
  return newline == std::string_view::npos ? 0 : begin + newline + 1;
}

}  // namespace

tl::expected<RecordingDownload, Error> RecordingDownload::open(const std::string& path) {
  // Not to wait for whoever writes into a pipe of that name.
  RecordingDownload download(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  struct stat status {};
  if (download.file_ == kNone || ::fstat(download.file_, &status) != 0) {
    return failure(fmt::format("{}: {}", path, std::strerror(errno)));
  }
  if (!S_ISREG(status.st_mode)) {
    return failure(fmt::format("{}: found no ordinary file, expected a recording", path));
  }
  const auto end = end_of_lines(download.file_, static_cast<std::uint64_t>(status.st_size));
  if (!end) {
    return failure(fmt::format("{}: {}", path, end.error().message));
  }
  download.size_ = *end;
  return download;
}

RecordingDownload::RecordingDownload(RecordingDownload&& other) noexcept
    : file_(std::exchange(other.file_, kNone)), size_(other.size_), read_(other.read_) {}

RecordingDownload::~RecordingDownload() {
  if (file_ != kNone) {
    ::close(file_);
  }
}

std::size_t RecordingDownload::read(std::span<char> bytes) {
  const std::size_t wanted = std::min<std::uint64_t>(bytes.size(), size_ - read_);
  const auto got = ::pread(file_, bytes.data(), wanted, static_cast<off_t>(read_));
  const auto count = static_cast<std::size_t>(std::max<ssize_t>(got, 0));
  read_ += count;
  return count;
}

std::string download_name(const std::string& path) {
  std::string name = std::filesystem::path(path).filename().string();
  std::ranges::replace_if(
      name,
      [](char c) {
        return !((c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                 c == '.' || c == '_' || c == '-');
      },
      '_');
  return name;
}

}  // namespace penduline
