// SPDX-License-Identifier: Apache-2.0
// The header of a recording: TOML that was behind '# '.
#pragma once

#include <cstdint>
#include <string>
#include <tl/expected.hpp>

#include "hal/error.hpp"
#include "hal/replay/recording_format.hpp"

namespace penduline {

/// What a header says, but for the number of sensors. `text` is its lines without their '#', `file`
/// and `first_line` are for messages. Fails where it is not TOML or a key is missing or wrong.
[[nodiscard]] tl::expected<RecordingHeader, Error> parse_recording_header(const std::string& text,
                                                                          const std::string& file,
                                                                          std::uint64_t first_line);

}  // namespace penduline
