// SPDX-License-Identifier: Apache-2.0
// The options of a recording beside a run, and the recorder that they ask for.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <tl/expected.hpp>

#include "hal/error.hpp"
#include "hal/replay/recording_format.hpp"
#include "host/recorder/recorder.hpp"
#include "host/recorder/recording_switch.hpp"

namespace penduline {

struct RecordingOptions {
  std::string path{};  ///< "": no recording
  RecordingLimits limits{};
  std::optional<std::chrono::milliseconds> sync_period{};
};

void add_recording_options(CLI::App& command, RecordingOptions& options);

/// A duration such as "90s", "1.5h": a number with s, min, h or d. None where it is not one of 1 s
/// to 1000 d.
[[nodiscard]] std::optional<std::int64_t> parse_duration_us(std::string_view text);

/// A size such as "100MB": a number with kB, MB, GB (powers of 1000) or KiB, MiB, GiB (of 1024).
/// None where it is not one of 10 kB to 1000 GB.
[[nodiscard]] std::optional<std::uint64_t> parse_size_bytes(std::string_view text);

/// Begins the recording that `options` ask for; says its name where that is not theirs. A live run
/// does not wait for the disk; of a board the recording tells when it began. What it warns of is
/// logged, and told to `warn`.
[[nodiscard]] tl::expected<std::unique_ptr<Recorder>, Error> start_recorder(
    const RecordingOptions& options, const RecordingHeader& header, bool live, bool board,
    RecordingSwitch::Warn warn);

}  // namespace penduline
