// SPDX-License-Identifier: Apache-2.0
// Bytes from and to a board, whatever carries them.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <tl/expected.hpp>

#include "hal/error.hpp"

namespace penduline {

class BytePort {
 public:
  BytePort() = default;
  BytePort(const BytePort&) = delete;
  BytePort& operator=(const BytePort&) = delete;
  virtual ~BytePort() = default;

  enum class Outcome { kBytes, kNothingYet, kEnd };
  struct Got {
    Outcome outcome;
    std::size_t bytes;
  };

  /// Waits for bytes, `patience` at most, and fills some in; kEnd where none will come any more. A
  /// signal ends the wait. Fails where the port has gone.
  virtual tl::expected<Got, Error> read(std::span<std::uint8_t> bytes,
                                        std::chrono::milliseconds patience) = 0;

  /// Sends all the bytes, or fails; does nothing where there is no way back.
  virtual tl::expected<void, Error> write(std::span<const std::uint8_t> bytes) = 0;

  /// Whether a board at the other end hears what is written, and may come back after it has gone.
  [[nodiscard]] virtual bool two_way() const = 0;
  /// For messages: "/dev/ttyACM0", "usb:1209:0001".
  [[nodiscard]] virtual const std::string& name() const = 0;
};

}  // namespace penduline
