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

tl::expected<PseudoTerminal, Error> PseudoTerminal::open() {
  PseudoTerminal pair;
  std::array<char, 64> path{};
  termios terminal{};
  pair.ours_ = ::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  if (pair.ours_ < 0 || ::grantpt(pair.ours_) != 0 || ::unlockpt(pair.ours_) != 0 ||
      ::ptsname_r(pair.ours_, path.data(), path.size()) != 0) {
    return failure(fmt::format("pty: {}", std::strerror(errno)));
  }
  pair.path_ = path.data();
  pair.theirs_ = ::open(path.data(), O_RDWR | O_NOCTTY | O_CLOEXEC);
  if (pair.theirs_ < 0 || ::tcgetattr(pair.theirs_, &terminal) != 0) {
    return failure(fmt::format("{}: {}", pair.path_, std::strerror(errno)));
  }
  ::cfmakeraw(&terminal);  // bytes pass as they are
  if (::tcsetattr(pair.theirs_, TCSANOW, &terminal) != 0) {
    return failure(fmt::format("{}: {}", pair.path_, std::strerror(errno)));
  }
  return pair;
}

PseudoTerminal::PseudoTerminal(PseudoTerminal&& other) noexcept
    : ours_(std::exchange(other.ours_, -1)),
      theirs_(std::exchange(other.theirs_, -1)),
      path_(std::move(other.path_)) {}

PseudoTerminal::~PseudoTerminal() {
  for (const int descriptor : {ours_, theirs_}) {
    if (descriptor >= 0) {
      ::close(descriptor);
    }
  }
}

}  // namespace penduline::sim
