// SPDX-License-Identifier: Apache-2.0
// `penduline run`: samples as they come, estimates at once.
#include <fmt/format.h>

#include <memory>
#include <string>

#include "host/cli/commands.hpp"
#include "host/cli/estimation_options.hpp"
#include "host/cli/log.hpp"
#include "host/cli/simulation_options.hpp"
#include "host/source/source.hpp"

namespace penduline {
namespace {

struct RunOptions {
  EstimationOptions estimation;
  SimulationOptions simulation;
  std::string uri;
  std::string record_path;
  bool fast = false;
};

ExitStatus run(const RunOptions& options, const SourceUri& source) {
  const auto rig = load_rig(options.estimation.rig_path);
  if (!rig) {
    return log_failure(rig.error());
  }
  SimulationSettings settings = simulation_settings(options.simulation, rig->rig);
  settings.duration_s = options.simulation.seconds;
  return estimate(options.estimation,
                  {.live = !options.fast,
                   .paced = !options.fast && source.kind != SourceUri::Kind::kBoard,
                   .record_path = options.record_path,
                   .input_path = source.path},
                  *rig, open_source(source, rig->rig, settings));
}

}  // namespace

void add_run_command(CLI::App& program, ExitStatus& status) {
  auto options = std::make_shared<RunOptions>();
  CLI::App* command = program.add_subcommand("run", "Turn samples into angles as they come");
  command
      ->add_option("SOURCE", options->uri,
                   "sim: (a simulated rig), file:PATH (a recording) or serial:PATH (a board)")
      ->required();
  add_estimation_options(*command, options->estimation);
  command->add_option("--record", options->record_path, "Also write the samples as a recording")
      ->type_name("FILE");
  command->add_flag("--fast", options->fast, "Do not wait for the samples' own times");
  add_simulation_options(*command, options->simulation,
                         "Until when a simulation runs; else endless");
  command->footer(
      "Runs until the source ends or Ctrl-C. Angles go to stdout, the summary to stderr.\n\n"
      "  penduline run sim: --rig rig.toml --case conical\n"
      "  penduline run sim: --rig rig.toml --seconds 60 --fast --record rec.csv -o angles.csv");
  command->final_callback([options, command, &status] {
    const SourceUri source = parse_uri(options->uri);
    if (source.kind == SourceUri::Kind::kUnknown) {
      throw CLI::ValidationError(
          "SOURCE",
          fmt::format("found '{}', expected sim:, file:PATH or serial:PATH", options->uri));
    }
    if (source.kind != SourceUri::Kind::kSimulation) {
      refuse_simulation_options(*command, "is for the source sim: only");
    }
    status = run(*options, source);
  });
}

}  // namespace penduline
