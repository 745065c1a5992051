// SPDX-License-Identifier: Apache-2.0
// System calls behind the simulated board's link.
#include "hal/sim/file_link.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <utility>

namespace penduline::sim {
namespace {

/// Whether a descriptor can be read or written now or within so many milliseconds; also where that
/// would fail.
bool is_ready(int descriptor, short events, int milliseconds) {
  pollfd state{.fd = descriptor, .events = events, .revents = 0};
  return descriptor >= 0 && ::poll(&state, 1, milliseconds) == 1;
}

/// stdin and stdout are shared with others and stay as they are: they are asked before each call.
bool failed_for_good(ssize_t result) {
  return result < 0 && errno != EAGAIN && errno != EINTR;
}

/// No echo, no lines, no characters with a meaning: bytes pass as they are.
bool make_raw(int descriptor) {
  termios terminal{};
  if (::tcgetattr(descriptor, &terminal) != 0) {
    return false;
  }
  ::cfmakeraw(&terminal);
  return ::tcsetattr(descriptor, TCSANOW, &terminal) == 0;
}

tl::unexpected<Error> system_failure(const std::string& name) {
  return failure(fmt::format("{}: {}", name, std::strerror(errno)));
}

}  // namespace

std::size_t FileLink::write(std::span<const std::uint8_t> bytes) {
  if (broken_ || !is_ready(out_, POLLOUT, 0)) {
    return 0;
  }
  const ssize_t written = ::write(out_, bytes.data(), bytes.size());
  broken_ = failed_for_good(written);
  return written > 0 ? static_cast<std::size_t>(written) : 0;
}

std::size_t FileLink::read(std::span<std::uint8_t> bytes) {
  if (ended_ || !is_ready(in_, POLLIN, 0)) {
    return 0;
  }
  const ssize_t count = ::read(in_, bytes.data(), bytes.size());
  ended_ = count == 0 || failed_for_good(count);
  return count > 0 ? static_cast<std::size_t>(count) : 0;
}

bool FileLink::asks_for_bootloader() const {
  termios terminal{};
  return ::tcgetattr(in_, &terminal) == 0 && ::cfgetospeed(&terminal) == B1200;
}

bool FileLink::wait_for_room(int milliseconds) const {
  return is_ready(out_, POLLOUT, milliseconds);
}

tl::expected<Terminal, Error> Terminal::open_pseudo() {
  Terminal pair;
  std::array<char, 64> path{};
  pair.ours_ = ::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  if (pair.ours_ < 0 || ::grantpt(pair.ours_) != 0 || ::unlockpt(pair.ours_) != 0 ||
      ::ptsname_r(pair.ours_, path.data(), path.size()) != 0) {
    return system_failure("pty");
  }
  pair.path_ = path.data();
  pair.theirs_ = ::open(path.data(), O_RDWR | O_NOCTTY | O_CLOEXEC);
  if (pair.theirs_ < 0 || !make_raw(pair.theirs_)) {
    return system_failure(pair.path_);
  }
  return pair;
}

tl::expected<Terminal, Error> Terminal::open_device(const std::string& path) {
  Terminal device;
  device.path_ = path;
  device.ours_ = ::open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  if (device.ours_ < 0 || !make_raw(device.ours_)) {
    return system_failure(path);
  }
  return device;
}

Terminal::Terminal(Terminal&& other) noexcept
    : ours_(std::exchange(other.ours_, -1)),
      theirs_(std::exchange(other.theirs_, -1)),
      path_(std::move(other.path_)) {}

Terminal::~Terminal() {
  for (const int descriptor : {ours_, theirs_}) {
    if (descriptor >= 0) {
      ::close(descriptor);
    }
  }
}

}  // namespace penduline::sim
