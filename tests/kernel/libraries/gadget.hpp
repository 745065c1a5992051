// SPDX-License-Identifier: Apache-2.0
// A board's USB plug on the kernel's dummy_hcd, and its firmware's end, on which a test plays the
// board.
#pragma once

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>

#include "tests/kernel/libraries/system_file.hpp"

namespace penduline::test {

inline constexpr std::uint16_t kVendor = 0x1209;
inline constexpr std::uint16_t kProduct = 0x0001;
inline constexpr const char* kSerialNumber = "0000000000000001";
inline constexpr const char* kPort = "/dev/ttyACM0";

/// Waits up to ten seconds; whether the condition came true.
template <class Condition>
[[nodiscard]] bool comes_true(const Condition& condition) {
  constexpr int kLooks = 10'000;
  for (int i = 0; i < kLooks && !condition(); ++i) {
    ::usleep(1000);
  }
  return condition();
}

inline bool port_exists() {
  return std::filesystem::exists(kPort);
}

/// A board that is plugged in for as long as this lives, unless it is unplugged before.
class Gadget {
 public:
  Gadget() : device_(::open("/dev/ttyGS0", O_RDWR | O_NOCTTY)) {
    plug();
    if (device_ < 0 || !comes_true(port_exists)) {
      throw std::runtime_error("the gadget did not come up");
    }
  }
  Gadget(const Gadget&) = delete;
  Gadget& operator=(const Gadget&) = delete;
  ~Gadget() {
    if (plugged_) {
      unplug();
    }
    ::close(device_);
    static_cast<void>(comes_true([] { return !port_exists(); }));
  }

  void plug() {
    write_system_file(std::getenv("UDC_FILE"), std::getenv("UDC"));
    plugged_ = true;
  }

  /// Pulls the cable. The firmware's end hangs up for good; the port goes a little later.
  void unplug() {
    write_system_file(std::getenv("UDC_FILE"), "");
    plugged_ = false;
  }

  /// The board sends; at most some kilobytes that nobody has read yet.
  void send(std::span<const std::uint8_t> bytes) const {
    if (::write(device_, bytes.data(), bytes.size()) != static_cast<ssize_t>(bytes.size())) {
      throw std::runtime_error("the gadget cannot send");
    }
  }

  /// What has come for the board within a second, or nothing.
  [[nodiscard]] std::string receive() const {
    constexpr int kPatienceMs = 1000;
    std::array<char, 256> bytes{};
    pollfd waited{.fd = device_, .events = POLLIN, .revents = 0};
    const ssize_t got =
        ::poll(&waited, 1, kPatienceMs) > 0 ? ::read(device_, bytes.data(), bytes.size()) : 0;
    return {bytes.data(), static_cast<std::size_t>(got > 0 ? got : 0)};
  }

 private:
  int device_;
  bool plugged_ = false;
};

}  // namespace penduline::test
