// SPDX-License-Identifier: Apache-2.0
// File descriptors as the simulated board's link: a terminal, or stdin and stdout.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <tl/expected.hpp>

#include "hal/concepts.hpp"
#include "hal/error.hpp"

namespace penduline::sim {

/// It never waits, and does not own what it reads and writes.
class FileLink {
 public:
  static constexpr std::size_t kWaitingBytes = 2048;

  FileLink(int in, int out) : in_(in), out_(out) {}

  std::size_t write(std::span<const std::uint8_t> bytes);
  std::size_t read(std::span<std::uint8_t> bytes);
  /// Nobody may be at the other end, which is no fault of the board.
  [[nodiscard]] bool stuck() const { return false; }
  /// The 1200-baud touch: the other end of a pseudo-terminal has set that speed.
  [[nodiscard]] bool asks_for_bootloader() const;

  /// Whether the other end is gone for good.
  [[nodiscard]] bool broken() const { return broken_; }
  /// Waits until the link takes bytes, so long at most; false where it still does not.
  [[nodiscard]] bool wait_for_room(int milliseconds) const;

 private:
  int in_;
  int out_;
  bool ended_ = false;  ///< nothing will come any more
  bool broken_ = false;
};

static_assert(ByteLink<FileLink>);

/// The board's end of a line of terminals, which passes every byte as it is.
class Terminal {
 public:
  /// A new pseudo-terminal whose other end any program may open, again and again, as a serial port.
  [[nodiscard]] static tl::expected<Terminal, Error> open_pseudo();
  /// A device that is there: a serial port, or a USB gadget's /dev/ttyGS0. Fails with the path and
  /// the system's reason.
  [[nodiscard]] static tl::expected<Terminal, Error> open_device(const std::string& path);

  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;
  Terminal(Terminal&& other) noexcept;
  Terminal& operator=(Terminal&& other) = delete;
  ~Terminal();

  /// The end of the board.
  [[nodiscard]] int descriptor() const { return ours_; }
  /// The end to be opened, "/dev/pts/3"; of a device itself.
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  Terminal() = default;

  int ours_ = -1;
  int theirs_ = -1;  ///< held open, so that bytes wait while no program has it open
  std::string path_;
};

}  // namespace penduline::sim
