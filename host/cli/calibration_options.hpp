// SPDX-License-Identifier: Apache-2.0
// The options that all methods of `penduline calibrate` share, and the work around them.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <tl/expected.hpp>
#include <vector>

#include "host/calibration/calibration.hpp"
#include "host/calibration/points_table.hpp"
#include "host/calibration/signal_log.hpp"
#include "host/cli/exit_status.hpp"
#include "host/rig_file.hpp"

namespace penduline {

using CalibrationOutcome = tl::expected<Calibration, Error>;

/// What all methods are asked.
struct CalibrationOptions {
  std::vector<std::string> recordings;
  std::string rig_path;
  std::string output_path;
  std::string plot_path;
  bool force = false;
  bool strict = false;
};

void add_calibration_options(CLI::App& command, CalibrationOptions& options);
CLI::Option* add_recordings(CLI::App& command, CalibrationOptions& options,
                            const std::string& help);

/// Reads the rig, calibrates, draws, writes the new rig, reports.
ExitStatus conclude_calibration(const CalibrationOptions& options,
                                const std::function<CalibrationOutcome(const RigFile&)>& calibrate);

/// A calibration from the recordings as a whole.
[[nodiscard]] CalibrationOutcome by_recordings(
    const CalibrationOptions& options, const RigFile& rig,
    const std::function<CalibrationOutcome(const std::vector<SignalLog>&)>& calibrate);

/// A calibration from a table of points.
[[nodiscard]] CalibrationOutcome by_points(
    const CalibrationOptions& options, const std::string& table, const RigFile& rig,
    const std::function<CalibrationOutcome(const SensorPoints&)>& calibrate);

}  // namespace penduline
