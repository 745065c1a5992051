// SPDX-License-Identifier: Apache-2.0
// From options to a session's lines.
#include "host/cli/line_options.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <cstdint>

#include "hal/linux/kernel_gpio.hpp"
#include "host/cli/log.hpp"
#include "host/cli/number_within.hpp"

namespace penduline {

void add_line_options(CLI::App& command, LineOptions& options) {
  constexpr double kMostS = 86400;
  command.add_flag("--reset", options.reset,
                   "Reset the board first, by the line [gpio] reset of the rig file");
  command
      .add_option(
          "--release", options.release_s,
          "Hold the pendulum by the magnet on the line [gpio] release of the rig file, and\n"
          "let it go so long after the first sample")
      ->check(number_within(0, kMostS))
      ->type_name("SECONDS");
}

void refuse_line_options(const LineOptions& options, const std::string& why) {
  if (options.reset) {
    throw CLI::ValidationError("--reset", why);
  }
  if (options.release_s) {
    throw CLI::ValidationError("--release", why);
  }
}

void require_lines(const LineOptions& options, const RigLines& rig, const std::string& rig_path) {
  const auto require = [&](bool wanted, const auto& line, const char* option, const char* key) {
    if (wanted && !line) {
      throw CLI::ValidationError(
          option, fmt::format("found no [gpio] {} in {}, expected the line's name", key, rig_path));
    }
  };
  require(options.reset, rig.reset, "--reset", "reset");
  require(options.release_s.has_value(), rig.release, "--release", "release");
}

tl::expected<std::unique_ptr<SessionLines>, Error> open_lines(const LineOptions& options,
                                                              const RigLines& rig, bool recording) {
  constexpr double kUsPerSecond = 1e6;
  LineSettings settings{.record_trigger = recording};
  if (options.release_s) {
    settings.release_after = std::chrono::microseconds(
        static_cast<std::int64_t>(std::round(*options.release_s * kUsPerSecond)));
  }
  KernelGpio gpio;
  auto lines = SessionLines::open(gpio, rig, settings, {.say = log_info, .warn = log_warning});
  if (!lines || !options.reset) {
    return lines;
  }
  if (const auto reset = (*lines)->reset_board(); !reset) {
    return tl::unexpected(reset.error());
  }
  return lines;
}

}  // namespace penduline
