// SPDX-License-Identifier: Apache-2.0
// What a source says of itself, for tests that care for little of it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "hal/replay/recording_format.hpp"

namespace penduline::test {

[[nodiscard]] inline RecordingHeader header_of(const std::string& board, double rate_hz = 20,
                                               std::optional<std::uint32_t> boot_id = {}) {
  return {.acquisition = {.rate_hz = rate_hz},
          .board = board,
          .firmware = "0.1.0",
          .started = "",
          .boot_id = boot_id};
}

}  // namespace penduline::test
