// SPDX-License-Identifier: Apache-2.0
// Opening, reading and writing by the system's calls.
#include "hal/linux/byte_stream.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

namespace penduline {
namespace {

constexpr int kClosedStream = -1;

/// No echo, no line editing, no characters with a meaning of their own; reads return what is there.
bool make_raw(int file) {
  termios settings{};
  if (tcgetattr(file, &settings) != 0) {
    return false;
  }
  cfmakeraw(&settings);
  settings.c_cflag |= CLOCAL | CREAD;
  return cfsetspeed(&settings, B460800) == 0 && tcsetattr(file, TCSANOW, &settings) == 0;
}

}  // namespace

tl::expected<ByteStream, Error> ByteStream::open(const std::string& path) {
  if (path == "-") {
    return ByteStream("standard input", STDIN_FILENO, false);
  }
  constexpr int kCommon = O_NOCTTY | O_CLOEXEC | O_NONBLOCK;
  int file = ::open(path.c_str(), O_RDWR | kCommon);
  if (file < 0 && (errno == EACCES || errno == EROFS)) {
    file = ::open(path.c_str(), O_RDONLY | kCommon);
  }
  if (file < 0) {
    return failure(fmt::format("{}: {}", path, std::strerror(errno)));
  }
  const bool serial = ::isatty(file) != 0;
  if (serial && !make_raw(file)) {
    const int reason = errno;
    ::close(file);
    return failure(fmt::format("{}: {}", path, std::strerror(reason)));
  }
  return ByteStream(path, file, serial);
}

ByteStream::ByteStream(std::string name, int file, bool two_way)
    : name_(std::move(name)), file_(file), two_way_(two_way) {}

ByteStream::ByteStream(ByteStream&& other) noexcept
    : name_(std::move(other.name_)),
      file_(std::exchange(other.file_, kClosedStream)),
      two_way_(other.two_way_) {}

ByteStream::~ByteStream() {
  if (file_ > STDERR_FILENO) {
    ::close(file_);
  }
}

tl::expected<ByteStream::Got, Error> ByteStream::read(std::span<std::uint8_t> bytes,
                                                      std::chrono::milliseconds patience) {
  pollfd waited{.fd = file_, .events = POLLIN, .revents = 0};
  const int ready = ::poll(&waited, 1, static_cast<int>(patience.count()));
  if (ready < 0) {
    return errno == EINTR ? tl::expected<Got, Error>(Got{Outcome::kEnd, 0})
                          : failure(fmt::format("{}: {}", name_, std::strerror(errno)));
  }
  if (ready == 0) {
    return Got{Outcome::kNothingYet, 0};
  }
  const ssize_t got = ::read(file_, bytes.data(), bytes.size());
  if (got < 0 && (errno == EAGAIN || errno == EINTR)) {
    return Got{Outcome::kNothingYet, 0};
  }
  if (got < 0) {
    return failure(fmt::format("{}: {}", name_, std::strerror(errno)));
  }
  return Got{got == 0 ? Outcome::kEnd : Outcome::kBytes, static_cast<std::size_t>(got)};
}

tl::expected<void, Error> ByteStream::write(std::span<const std::uint8_t> bytes) {
  constexpr int kPatienceMs = 1000;
  while (two_way_ && !bytes.empty()) {
    pollfd waited{.fd = file_, .events = POLLOUT, .revents = 0};
    const ssize_t sent =
        ::poll(&waited, 1, kPatienceMs) > 0 ? ::write(file_, bytes.data(), bytes.size()) : 0;
    if (sent <= 0) {
      return failure(fmt::format("{}: the board takes no commands: {}", name_,
                                 sent < 0 ? std::strerror(errno) : "no room for a second"));
    }
    bytes = bytes.subspan(static_cast<std::size_t>(sent));
  }
  return {};
}

}  // namespace penduline
