// SPDX-License-Identifier: Apache-2.0
// From a method's outcome to a rig file, a figure and a report.
#include "host/cli/calibration_options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iterator>

#include "hal/replay/utc_text.hpp"
#include "host/calibration/calibration_report.hpp"
#include "host/cli/estimation_options.hpp"
#include "host/cli/log.hpp"
#include "host/output/text_file.hpp"

namespace penduline {
namespace {

std::string utc_now() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return utc_text_s(std::chrono::duration_cast<std::chrono::microseconds>(now).count());
}

tl::expected<void, Error> require_free_output(const CalibrationOptions& options) {
  std::vector<std::string> paths{options.output_path, options.plot_path};
  std::ranges::transform(options.recordings, std::back_inserter(paths), named_input);
  if (auto distinct = require_distinct_files(paths); !distinct) {
    return distinct;
  }
  if (options.output_path == "-") {
    return failure("--output: found '-', expected a file: the report goes to the standard output");
  }
  std::error_code error;
  if (!options.force && std::filesystem::exists(options.output_path, error)) {
    return failure(fmt::format("{}: is there already, expected a new file; --force writes over it",
                               options.output_path));
  }
  return {};
}

/// Says whether there was nothing to warn of.
tl::expected<bool, Error> write_calibration(
    const CalibrationOptions& options,
    const std::function<CalibrationOutcome(const RigFile&)>& calibrate) {
  if (const auto is_free = require_free_output(options); !is_free) {
    return tl::unexpected(is_free.error());
  }
  const auto rig = load_rig(options.rig_path);
  if (!rig) {
    return tl::unexpected(rig.error());
  }
  auto result = calibrate(*rig);
  if (!result) {
    return tl::unexpected(result.error());
  }
  for (const std::string& warning : result->warnings) {
    log_warning(warning);
  }
  result->record.date = utc_now();
  if (result->record.recordings.empty()) {
    result->record.recordings = options.recordings;
  }
  if (!options.plot_path.empty()) {
    if (const auto drawn = draw(result->figure, options.plot_path); !drawn) {
      return tl::unexpected(drawn.error());
    }
  }
  const auto text = rewritten_rig(options.rig_path, result->changes, result->record);
  if (!text) {
    return tl::unexpected(text.error());
  }
  if (const auto written = put_file(options.output_path, *text); !written) {
    return tl::unexpected(written.error());
  }
  fmt::print("{}\nthe new rig: {}\n", report_of(*result), options.output_path);
  return result->warnings.empty();
}

/// The outcome with what its recordings complained of first. Where it failed, that may be why: it
/// is told at once.
CalibrationOutcome with_complaints(const std::vector<std::string>& complaints,
                                   CalibrationOutcome outcome) {
  if (!outcome) {
    std::ranges::for_each(complaints, log_warning);
    return outcome;
  }
  std::vector<std::string>& warnings = outcome->warnings;
  warnings.insert(warnings.begin(), complaints.begin(), complaints.end());
  return outcome;
}

}  // namespace

void add_calibration_options(CLI::App& command, CalibrationOptions& options) {
  add_rig_option(command, options.rig_path);
  command
      .add_option("-o,--output", options.output_path,
                  "Where the new rig goes, with a section [calibration]; comments are lost")
      ->required()
      ->type_name("FILE");
  command
      .add_option("--plot", options.plot_path,
                  "Draw what was fitted and the residuals: .svg, .pdf or .png")
      ->type_name("FILE");
  command.add_flag("--force", options.force, "Write over a rig that is there, even the one read");
  command.add_flag(
      "--strict", options.strict,
      "End with status 3 where there was anything to warn of, of the recordings or the outcome");
}

CLI::Option* add_recordings(CLI::App& command, CalibrationOptions& options,
                            const std::string& help) {
  return command.add_option("FILE", options.recordings, help);
}

ExitStatus conclude_calibration(
    const CalibrationOptions& options,
    const std::function<CalibrationOutcome(const RigFile&)>& calibrate) {
  const auto sound = write_calibration(options, calibrate);
  if (!sound) {
    return log_failure(sound.error());
  }
  return options.strict && !*sound ? ExitStatus::kDoubtful : ExitStatus::kDone;
}

CalibrationOutcome by_recordings(
    const CalibrationOptions& options, const RigFile& rig,
    const std::function<CalibrationOutcome(const std::vector<SignalLog>&)>& calibrate) {
  const auto logs = read_signals(options.recordings, rig.rig.layout.count);
  if (!logs) {
    return tl::unexpected(logs.error());
  }
  std::vector<std::string> complaints;
  for (const SignalLog& log : *logs) {
    complaints.insert(complaints.end(), log.complaints.begin(), log.complaints.end());
  }
  return with_complaints(complaints, calibrate(*logs));
}

CalibrationOutcome by_points(
    const CalibrationOptions& options, const std::string& table, const RigFile& rig,
    const std::function<CalibrationOutcome(const SensorPoints&)>& calibrate) {
  if (options.recordings.size() > 1) {
    return failure(
        fmt::format("found {} recordings beside --points, expected one at most: more "
                    "stand in the table's column 'recording'",
                    options.recordings.size()));
  }
  const auto points = read_points(
      table, options.recordings.empty() ? "" : options.recordings.front(), rig.rig.layout.count);
  if (!points) {
    return tl::unexpected(points.error());
  }
  std::vector<std::string> complaints;
  const auto measured = measure_points(*points, rig.rig.layout, complaints);
  if (!measured) {
    return with_complaints(complaints, tl::unexpected(measured.error()));
  }
  return with_complaints(complaints, calibrate(*measured)).map([&](Calibration result) {
    for (const KnownPoint& point : *points) {
      std::vector<std::string>& named = result.record.recordings;
      if (std::ranges::find(named, point.recording) == named.end()) {
        named.push_back(point.recording);
      }
    }
    return result;
  });
}

}  // namespace penduline
