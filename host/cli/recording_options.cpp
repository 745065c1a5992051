// SPDX-License-Identifier: Apache-2.0
// From options to a recorder.
#include "host/cli/recording_options.hpp"

#include <fmt/format.h>

#include <cmath>
#include <span>
#include <utility>

#include "hal/replay/cells.hpp"
#include "host/cli/log.hpp"

namespace penduline {
namespace {

struct Unit {
  std::string_view name;
  double factor;
};

constexpr Unit kDurationUnits[] = {{"s", 1e6}, {"min", 60e6}, {"h", 3600e6}, {"d", 86400e6}};
constexpr Unit kSizeUnits[] = {{"kB", 1e3},    {"MB", 1e6},           {"GB", 1e9},
                               {"KiB", 1024.}, {"MiB", 1024. * 1024}, {"GiB", 1024. * 1024 * 1024}};

/// A number with one of the units behind it, in the least unit; none where it is something else or
/// out of range.
std::optional<double> parse_with_unit(std::string_view text, std::span<const Unit> units,
                                      double least, double most) {
  const std::size_t begin = text.find_last_of("0123456789.") + 1;
  for (const Unit& unit : units) {
    if (unit.name == trimmed(text.substr(begin))) {
      const auto number = parse_number<double>(text.substr(0, begin));
      const double value = number.value_or(-1) * unit.factor;
      return value >= least && value <= most ? std::optional(std::round(value)) : std::nullopt;
    }
  }
  return std::nullopt;
}

void parse_limits(const std::vector<std::string>& texts, RecordingLimits& limits) {
  for (const std::string& text : texts) {
    const auto duration_us = parse_duration_us(text);
    const auto bytes = parse_size_bytes(text);
    if ((!duration_us && !bytes) || (duration_us && limits.duration_us) ||
        (bytes && limits.bytes)) {
      throw CLI::ValidationError(
          "--record-every",
          fmt::format(
              "found '{}', expected a duration from 1s to 1000d (s, min, h, d), a size from "
              "10kB to 1000GB (kB, MB, GB, KiB, MiB, GiB), or one of each",
              text));
    }
    limits.duration_us = duration_us ? duration_us : limits.duration_us;
    limits.bytes = bytes ? bytes : limits.bytes;
  }
}

void parse_sync_period(const std::string& text, RecordingOptions& options) {
  const auto period_us = parse_duration_us(text);
  if (!period_us) {
    throw CLI::ValidationError(
        "--fsync", fmt::format("found '{}', expected a duration from 1s to 1000d", text));
  }
  options.sync_period = std::chrono::milliseconds(*period_us / 1000);
}

}  // namespace

void add_recording_options(CLI::App& command, RecordingOptions& options) {
  CLI::Option* record =
      command
          .add_option(
              "--record", options.path,
              "Also write the samples as a recording. A file that is there is kept, the new\n"
              "one numbered; %Y, %m, %d, %H, %M, %S in the name become the time in UTC")
          ->type_name("FILE");
  command
      .add_option_function<std::vector<std::string>>(
          "--record-every",
          [&options](const std::vector<std::string>& texts) {
            parse_limits(texts, options.limits);
          },
          "Begin a new file each time that so much has been recorded: 1h, 100MB, or 1h,100MB\n"
          "for whichever is first. FILE.csv becomes FILE-0001.csv, FILE-0002.csv, ...")
      ->delimiter(',')
      ->needs(record)
      ->type_name("DURATION|SIZE");
  command
      .add_option_function<std::string>(
          "--fsync", [&options](const std::string& text) { parse_sync_period(text, options); },
          "Bring the recording to the disk so often, 10s or 1min; else the system does it, within\n"
          "half a minute as a rule, and a power failure costs what was recorded since")
      ->needs(record)
      ->type_name("DURATION");
}

std::optional<std::int64_t> parse_duration_us(std::string_view text) {
  const auto us = parse_with_unit(text, kDurationUnits, 1e6, 1000 * 86400e6);
  return us ? std::optional(static_cast<std::int64_t>(*us)) : std::nullopt;
}

std::optional<std::uint64_t> parse_size_bytes(std::string_view text) {
  const auto bytes = parse_with_unit(text, kSizeUnits, 10e3, 1000e9);
  return bytes ? std::optional(static_cast<std::uint64_t>(*bytes)) : std::nullopt;
}

tl::expected<std::unique_ptr<Recorder>, Error> start_recorder(const RecordingOptions& options,
                                                              const RecordingHeader& header,
                                                              bool live, bool board,
                                                              RecordingSwitch::Warn warn) {
  using WhenFull = RecordingQueue::WhenFull;
  RecorderSettings settings{.series = {.path = options.path,
                                       .limits = options.limits,
                                       .tell_start = board,
                                       .warn =
                                           [warn = std::move(warn)](const std::string& text) {
                                             log_warning(text);
                                             warn(text);
                                           }},
                            .sync_period = options.sync_period,
                            .when_full = live ? WhenFull::kLose : WhenFull::kWait};
  auto recorder = Recorder::start(std::move(settings), header);
  if (recorder && options.path != "-" && (*recorder)->name() != options.path) {
    log_info("recording in " + (*recorder)->name());
  }
  return recorder;
}

}  // namespace penduline
