// SPDX-License-Identifier: Apache-2.0
// A link in memory, held by the test at its other end: it may refuse bytes, stick, or be touched.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "hal/concepts.hpp"

namespace penduline::test {

struct MemoryLink {
  static constexpr std::size_t kWaitingBytes = 2048;
  std::vector<std::uint8_t> sent{};     ///< what the firmware wrote
  std::vector<std::uint8_t> to_read{};  ///< what the firmware is still to read
  std::size_t room = kEndless;          ///< bytes that it takes until it is given more
  std::size_t most_at_once = kEndless;  ///< bytes that one write takes
  bool is_stuck = false;
  bool is_touched = false;

  static constexpr std::size_t kEndless = std::numeric_limits<std::size_t>::max();

  std::size_t write(std::span<const std::uint8_t> bytes) {
    const std::size_t taken = std::min({bytes.size(), room, most_at_once});
    sent.insert(sent.end(), bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(taken));
    room = room == kEndless ? kEndless : room - taken;
    return taken;
  }
  std::size_t read(std::span<std::uint8_t> bytes) {
    const std::size_t given = std::min(bytes.size(), to_read.size());
    const auto end = to_read.begin() + static_cast<std::ptrdiff_t>(given);
    std::copy(to_read.begin(), end, bytes.begin());
    to_read.erase(to_read.begin(), end);
    return given;
  }
  [[nodiscard]] bool stuck() const { return is_stuck; }
  [[nodiscard]] bool asks_for_bootloader() const { return is_touched; }
};

static_assert(ByteLink<MemoryLink>);

}  // namespace penduline::test
