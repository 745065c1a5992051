// SPDX-License-Identifier: Apache-2.0
// Writing text with every failure reported.
#include "host/output/text_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <climits>
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <string_view>
#include <utility>

namespace penduline {
namespace {

constexpr std::size_t kLargeBytes = std::size_t{64} * 1024;
constexpr int kClosed = -1;
constexpr int kReadableByAll = 0644;

/// A path without links and dots, also of a file that is yet to be created.
std::filesystem::path resolved(const std::filesystem::path& path) {
  std::error_code failed;
  const auto target = std::filesystem::read_symlink(path, failed);
  return std::filesystem::weakly_canonical(failed ? path : path.parent_path() / target, failed);
}

}  // namespace

tl::expected<TextFile, Error> TextFile::create(const std::string& path) {
  if (path == "-") {
    return TextFile("standard output", STDOUT_FILENO);
  }
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, kReadableByAll);
  if (file < 0) {
    return failure(fmt::format("{}: {}", path, std::strerror(errno)));
  }
  return TextFile(path, file);
}

TextFile::TextFile(std::string name, int file) : name_(std::move(name)), file_(file) {
  text_.reserve(2 * kLargeBytes);
}

TextFile::TextFile(TextFile&& other) noexcept
    : name_(std::move(other.name_)),
      file_(std::exchange(other.file_, kClosed)),
      text_(std::move(other.text_)) {}

TextFile::~TextFile() {
  if (file_ > STDERR_FILENO) {
    ::close(file_);
  }
}

tl::expected<void, Error> TextFile::flush_if_large() {
  return text_.size() < kLargeBytes ? tl::expected<void, Error>() : flush();
}

tl::expected<void, Error> TextFile::flush() {
  std::string_view left = text_;
  while (!left.empty()) {
    const ssize_t written = ::write(file_, left.data(), left.size());
    if (written < 0 && errno != EINTR) {
      const int reason = errno;
      text_.clear();
      return failure(fmt::format("{}: {}", name_, std::strerror(reason)));
    }
    left.remove_prefix(written < 0 ? 0 : static_cast<std::size_t>(written));
  }
  text_.clear();
  return {};
}

tl::expected<void, Error> TextFile::write_piece() {
  const ssize_t written =
      ::write(file_, text_.data(), std::min(text_.size(), std::size_t{PIPE_BUF}));
  if (written < 0 && errno != EINTR && errno != EAGAIN) {
    return failure(fmt::format("{}: {}", name_, std::strerror(errno)));
  }
  text_.erase(0, written < 0 ? 0 : static_cast<std::size_t>(written));
  return {};
}

tl::expected<void, Error> put_file(const std::string& path, const std::string& text) {
  const std::string unfinished = path + ".part";
  auto file = TextFile::create(unfinished);
  if (!file) {
    return tl::unexpected(file.error());
  }
  file->text() = text;
  std::error_code error;
  if (auto flushed = file->flush(); !flushed) {
    std::filesystem::remove(unfinished, error);
    return flushed;
  }
  std::filesystem::rename(unfinished, path, error);
  if (error) {
    std::error_code ignored;
    std::filesystem::remove(unfinished, ignored);
    return failure(fmt::format("{}: cannot write: {}", path, error.message()));
  }
  return {};
}

tl::expected<void, Error> require_file(const std::string& path) {
  if (path == "-") {
    return failure("found the standard input, expected a file: it is read more than once");
  }
  return {};
}

tl::expected<void, Error> require_folder(const std::string& path) {
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  std::error_code failed;  // of a folder that may not be looked into, writing says more
  const std::filesystem::file_status status = std::filesystem::status(folder, failed);
  if (!folder.empty() && status_known(status) && !is_directory(status)) {
    return failure(fmt::format("{}: there is no folder {}", path, folder.string()));
  }
  return {};
}

tl::expected<void, Error> require_distinct_files(std::span<const std::string> paths) {
  const auto same_file = [](const std::string& one, const std::string& other) {
    std::error_code failed;
    if (std::filesystem::exists(one, failed) && !std::filesystem::is_regular_file(one, failed)) {
      return false;
    }
    return resolved(one) == resolved(other) || std::filesystem::equivalent(one, other, failed);
  };
  for (std::size_t i = 0; i < paths.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (!paths[i].empty() && same_file(paths[i], paths[j])) {
        return failure(
            fmt::format("{}: stands for two files of this run, expected two names", paths[i]));
      }
    }
  }
  return {};
}

}  // namespace penduline
