// SPDX-License-Identifier: Apache-2.0
// The options of a simulated rig, shared by `simulate` and `run sim:`.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "hal/sim/simulated_rig.hpp"

namespace penduline {

/// Named starts: the paper's cases 1 and 2, and the conical swing that case 2 aims at.
enum class SwingCase { kOne, kTwo, kConical };

struct SimulationOptions {
  SwingCase swing_case = SwingCase::kOne;
  std::optional<double> theta_deg;
  std::optional<double> phi_deg;
  std::optional<double> omega_rad_s;
  std::optional<double> psi_rad_s;
  std::optional<double> seconds;
  bool held = false;
  bool ideal = false;
  bool emitter_always_lit = false;
  SimulationSettings settings;
};

/// `seconds_help` says what happens without --seconds.
void add_simulation_options(CLI::App& command, SimulationOptions& options,
                            const std::string& seconds_help);

/// Throws CLI::ValidationError, saying `why`, where one of these options was given, `but` for one.
void refuse_simulation_options(const CLI::App& command, const std::string& why,
                               const std::string& but = "");

/// What the options ask for; the duration is the case's own unless --seconds says otherwise. Throws
/// CLI::ValidationError where the integrator or the case cannot start from the tilt.
[[nodiscard]] SimulationSettings simulation_settings(const SimulationOptions& options,
                                                     const Rig<double>& rig);

}  // namespace penduline
