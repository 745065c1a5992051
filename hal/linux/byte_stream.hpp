// SPDX-License-Identifier: Apache-2.0
// Bytes from and to a board: a serial port, or any file or pipe that stands in for one.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <tl/expected.hpp>

#include "hal/error.hpp"

namespace penduline {

class ByteStream {
 public:
  /// Opens a serial port, as raw as it gets and at 460800 baud (USB ignores that), a pipe or a
  /// file;
  /// "-" is the standard input. Fails with the path and the system's reason.
  static tl::expected<ByteStream, Error> open(const std::string& path);

  ByteStream(const ByteStream&) = delete;
  ByteStream(ByteStream&& other) noexcept;
  ByteStream& operator=(const ByteStream&) = delete;
  ByteStream& operator=(ByteStream&&) = delete;
  ~ByteStream();

  enum class Outcome { kBytes, kNothingYet, kEnd };
  struct Got {
    Outcome outcome;
    std::size_t bytes;
  };

  /// Waits for bytes and fills some in. A signal ends the stream; `patience` ends the wait.
  tl::expected<Got, Error> read(std::span<std::uint8_t> bytes, std::chrono::milliseconds patience);

  /// Sends to a serial port; does nothing where there is no way back.
  tl::expected<void, Error> write(std::span<const std::uint8_t> bytes);

  /// Whether a board at the other end hears what is written.
  [[nodiscard]] bool two_way() const { return two_way_; }
  [[nodiscard]] const std::string& name() const { return name_; }

 private:
  ByteStream(std::string name, int file, bool two_way);

  std::string name_;
  int file_;
  bool two_way_;
};

}  // namespace penduline
