// SPDX-License-Identifier: Apache-2.0
// A serial port as a BytePort, or any file or pipe that stands in for one.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <tl/expected.hpp>

#include "hal/linux/byte_port.hpp"

namespace penduline {

class SerialPort final : public BytePort {
 public:
  static constexpr std::uint32_t kDefaultBaud = 460'800;

  /// Opens a serial port, as raw as it gets, a pipe or a file; "-" is the standard input. USB
  /// ignores the baud rate. A port is locked: it fails where another program has it. Fails with the
  /// path and the system's reason.
  static tl::expected<std::unique_ptr<BytePort>, Error> open(const std::string& path,
                                                             std::uint32_t baud = kDefaultBaud);

  SerialPort(const SerialPort&) = delete;
  SerialPort& operator=(const SerialPort&) = delete;
  ~SerialPort() override;

  tl::expected<Got, Error> read(std::span<std::uint8_t> bytes,
                                std::chrono::milliseconds patience) override;
  tl::expected<void, Error> write(std::span<const std::uint8_t> bytes) override;
  [[nodiscard]] bool two_way() const override { return two_way_; }
  [[nodiscard]] const std::string& name() const override { return name_; }

 private:
  SerialPort(std::string name, int file, bool two_way);

  std::string name_;
  int file_;
  bool two_way_;
};

}  // namespace penduline
