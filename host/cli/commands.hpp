// SPDX-License-Identifier: Apache-2.0
// The subcommands of the program.
#pragma once

#include <CLI/CLI.hpp>

#include "host/cli/exit_status.hpp"

namespace penduline {

/// Each adds its subcommand to the program; when the subcommand has run, `status` tells how it
/// ended.
void add_analyze_command(CLI::App& program, ExitStatus& status);
void add_calibrate_command(CLI::App& program, ExitStatus& status);
void add_devices_command(CLI::App& program, ExitStatus& status);
void add_doctor_command(CLI::App& program, ExitStatus& status);
void add_plot_command(CLI::App& program, ExitStatus& status);
void add_replay_command(CLI::App& program, ExitStatus& status);
void add_report_command(CLI::App& program, ExitStatus& status);
void add_run_command(CLI::App& program, ExitStatus& status);
void add_simulate_command(CLI::App& program, ExitStatus& status);

}  // namespace penduline
