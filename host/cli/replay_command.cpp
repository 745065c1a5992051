// SPDX-License-Identifier: Apache-2.0
// `penduline replay`: a recording in, estimates out.
#include <memory>
#include <optional>
#include <string>

#include "hal/replay/recording_format.hpp"
#include "hal/replay/voltage_log_reader.hpp"
#include "host/cli/commands.hpp"
#include "host/cli/estimation_options.hpp"
#include "host/cli/log.hpp"
#include "host/cli/number_within.hpp"
#include "host/source/source.hpp"
#include "host/web/web_server.hpp"

namespace penduline {
namespace {

struct ReplayOptions {
  EstimationOptions estimation;
  std::string path;
  std::optional<std::string> import_columns;
  std::optional<double> rate_hz;
};

tl::expected<std::unique_ptr<Source>, Error> open_replay(const ReplayOptions& options) {
  if (!options.import_columns) {
    return open_recording(options.path);
  }
  auto layout = parse_log_layout(*options.import_columns);
  if (!layout) {
    throw CLI::ValidationError("--import", layout.error().message);
  }
  layout->rate_hz = options.rate_hz;
  return open_voltage_log(options.path, *layout);
}

ExitStatus replay(const ReplayOptions& options) {
  const auto rig = load_rig(options.estimation.rig_path);
  if (!rig) {
    return log_failure(rig.error());
  }
  const StopSignal stop;
  return estimate(
      options.estimation, {.input_path = options.path}, *rig, [&] { return open_replay(options); },
      stop);
}

}  // namespace

void add_replay_command(CLI::App& program, ExitStatus& status) {
  auto options = std::make_shared<ReplayOptions>();
  CLI::App* command = program.add_subcommand("replay", "Turn a recording into angles");
  command->add_option("FILE", options->path, "The recording; - is the standard input")->required();
  add_estimation_options(*command, options->estimation);
  CLI::Option* import = command->add_option(
      "--import", options->import_columns,
      "FILE is a plain log of voltages with these columns, such as t_s,x,y or x,y:\n"
      "t_s, t_ms or t_us the time; x, y, s3, ... volts of the sensors; - a column to skip");
  import->type_name("COLUMNS");
  command
      ->add_option("--rate", options->rate_hz,
                   "Sample rate of a log: needed without times; with them it decides what is a\n"
                   "dropout, in place of the first two rows")
      ->needs(import)
      ->check(number_within(kSlowestHz, kFastestHz))
      ->type_name("HZ");
  command->footer(
      "One row a sample: t_s,seq,theta1_rad,theta2_rad,x_m,y_m,z_m,... (docs/formats.md).\n"
      "A row that cannot be computed has empty cells and says why in its flags.\n\n"
      "  penduline replay rec.csv --rig rig.toml -o angles.csv\n"
      "  penduline replay daq.csv --import t_s,x,y --rig rig.toml --format jsonl");
  command->final_callback([options, &status] {
    refuse_network_outputs(options->estimation.output);
    status = replay(*options);
  });
}

}  // namespace penduline
