// SPDX-License-Identifier: Apache-2.0
// The program `penduline`.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <exception>
#include <string>
#include <vector>

#include "host/cli/commands.hpp"
#include "host/cli/log.hpp"
#include "host/cli/self_description.hpp"

namespace penduline {
namespace {

int run_program(int argc, char** argv) {
  start_log();
  ExitStatus status = ExitStatus::kDone;
  CLI::App program(
      "Penduline measures the two angles of a spherical pendulum without touching it.\n"
      "Angles go to stdout, everything else to stderr.",
      "penduline");
  program.set_version_flag("--version", "penduline " PENDULINE_VERSION);
  program.require_subcommand(1);
  add_analyze_command(program, status);
  add_calibrate_command(program, status);
  add_devices_command(program, status);
  add_doctor_command(program, status);
  add_plot_command(program, status);
  add_replay_command(program, status);
  add_report_command(program, status);
  add_run_command(program, status);
  add_simulate_command(program, status);
  program.footer(
      "Exit status: 0 done; 1 failed, with one line on stderr; 2 wrong usage; 3 finished, but the\n"
      "data had flagged problems and --strict was given. 'penduline COMMAND --help' teaches more.");
  if (const auto description = describe_itself(program, {argv, argv + argc})) {
    fmt::print("{}", *description);
    return static_cast<int>(ExitStatus::kDone);
  }
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    const bool asked_for = error.get_exit_code() == 0;  // --help, --version
    const bool unknown_command = argc > 1 && argv[1][0] != '-' && program.get_subcommands().empty();
    if (unknown_command) {
      std::vector<std::string> names;
      for (const CLI::App* command : program.get_subcommands([](CLI::App*) { return true; })) {
        names.push_back(command->get_name());
      }
      log_failure(
          {fmt::format("found command '{}', expected {}", argv[1], fmt::join(names, ", "))});
      return static_cast<int>(ExitStatus::kUsage);
    }
    program.exit(error);
    return static_cast<int>(asked_for ? ExitStatus::kDone : ExitStatus::kUsage);
  }
  return static_cast<int>(status);
}

}  // namespace
}  // namespace penduline

int main(int argc, char** argv) {
  // A file at the largest size that is allowed is an error of that file, not the program's end.
  std::signal(SIGXFSZ, SIG_IGN);
  int status = 0;
  try {
    status = penduline::run_program(argc, argv);
  } catch (const std::exception& error) {
    status = static_cast<int>(penduline::log_failure({error.what()}));
  }
  penduline::finish_log();
  return status;
}
