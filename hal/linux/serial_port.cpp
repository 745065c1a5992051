// SPDX-License-Identifier: Apache-2.0
// Opening, reading and writing by the system's calls.
#include "hal/linux/serial_port.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/file.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

namespace penduline {
namespace {

struct Speed {
  std::uint32_t baud;
  speed_t code;
};
constexpr std::array kSpeeds = {
    Speed{9600, B9600},     Speed{19200, B19200},    Speed{38400, B38400},   Speed{57600, B57600},
    Speed{115200, B115200}, Speed{230400, B230400},  Speed{460800, B460800}, Speed{500000, B500000},
    Speed{921600, B921600}, Speed{1000000, B1000000}};

tl::expected<speed_t, Error> speed_of(std::uint32_t baud) {
  std::string known;
  for (const Speed& speed : kSpeeds) {
    if (speed.baud == baud) {
      return speed.code;
    }
    known += fmt::format("{}{}", known.empty() ? "" : ", ", speed.baud);
  }
  return failure(fmt::format("found a rate of {} baud, expected one of {}", baud, known));
}

/// No echo, no line editing, no characters with a meaning of their own; reads return what is there.
bool make_raw(int file, speed_t speed) {
  termios settings{};
  if (tcgetattr(file, &settings) != 0) {
    return false;
  }
  cfmakeraw(&settings);
  settings.c_cflag |= CLOCAL | CREAD;
  return cfsetspeed(&settings, speed) == 0 && tcsetattr(file, TCSANOW, &settings) == 0;
}

/// Why the last call failed, in words.
std::string reason() {
  return std::strerror(errno);
}

}  // namespace

tl::expected<std::unique_ptr<BytePort>, Error> SerialPort::open(const std::string& path,
                                                                std::uint32_t baud) {
  const auto speed = speed_of(baud);
  if (!speed) {
    return failure(fmt::format("{}: {}", path, speed.error().message));
  }
  if (path == "-") {
    return std::unique_ptr<BytePort>(new SerialPort("standard input", STDIN_FILENO, false));
  }
  constexpr int kCommon = O_NOCTTY | O_CLOEXEC | O_NONBLOCK;
  int file = ::open(path.c_str(), O_RDWR | kCommon);
  if (file < 0 && (errno == EACCES || errno == EROFS)) {
    file = ::open(path.c_str(), O_RDONLY | kCommon);
  }
  if (file < 0) {
    return failure(fmt::format("{}: {}", path, reason()));
  }
  const bool serial = ::isatty(file) != 0;
  std::unique_ptr<SerialPort> port(new SerialPort(path, file, serial));
  if (serial && ::flock(file, LOCK_EX | LOCK_NB) != 0) {
    return failure(fmt::format("{}: another program has the port", path));
  }
  if (serial && !make_raw(file, *speed)) {
    return failure(fmt::format("{}: {}", path, reason()));
  }
  return port;
}

SerialPort::SerialPort(std::string name, int file, bool two_way)
    : name_(std::move(name)), file_(file), two_way_(two_way) {}

SerialPort::~SerialPort() {
  if (file_ > STDERR_FILENO) {
    ::tcflush(file_, TCOFLUSH);  // or closing would wait for a board that reads nothing
    ::close(file_);
  }
}

tl::expected<BytePort::Got, Error> SerialPort::read(std::span<std::uint8_t> bytes,
                                                    std::chrono::milliseconds patience) {
  pollfd waited{.fd = file_, .events = POLLIN, .revents = 0};
  const int ready = ::poll(&waited, 1, static_cast<int>(patience.count()));
  if (ready < 0 && errno != EINTR) {
    return failure(fmt::format("{}: {}", name_, reason()));
  }
  if (ready <= 0) {
    return Got{Outcome::kNothingYet, 0};
  }
  const ssize_t got = ::read(file_, bytes.data(), bytes.size());
  if (got < 0 && (errno == EAGAIN || errno == EINTR)) {
    return Got{Outcome::kNothingYet, 0};
  }
  if (got < 0) {
    return failure(fmt::format("{}: {}", name_, reason()));
  }
  return Got{got == 0 ? Outcome::kEnd : Outcome::kBytes, static_cast<std::size_t>(got)};
}

tl::expected<void, Error> SerialPort::write(std::span<const std::uint8_t> bytes) {
  constexpr int kPatienceMs = 1000;
  while (two_way_ && !bytes.empty()) {
    pollfd waited{.fd = file_, .events = POLLOUT, .revents = 0};
    const int ready = ::poll(&waited, 1, kPatienceMs);
    if (ready == 0) {
      return failure(fmt::format("{}: the board takes no commands: no room for a second", name_));
    }
    const ssize_t sent = ready < 0 ? -1 : ::write(file_, bytes.data(), bytes.size());
    if (sent < 0 && errno != EINTR && errno != EAGAIN) {
      return failure(fmt::format("{}: the board takes no commands: {}", name_, reason()));
    }
    bytes = bytes.subspan(sent < 0 ? 0 : static_cast<std::size_t>(sent));
  }
  return {};
}

}  // namespace penduline
