// SPDX-License-Identifier: Apache-2.0
// From options to a simulated rig.
#include "host/cli/simulation_options.hpp"

#include <cmath>
#include <map>
#include <numbers>
#include <string_view>

#include "host/cli/number_within.hpp"

namespace penduline {
namespace {

constexpr double kRadPerDeg = std::numbers::pi / 180;
constexpr double kCaseThetaDeg = 10;
constexpr double kCasePhiDeg = 45;
constexpr double kCaseTwoPsi = 2;         // rad/s, sec. 3.2
constexpr double kCaseTwoSeconds = 50;    // 1000 iterations of 0.05 s
constexpr double kOtherCaseSeconds = 10;  // 200 iterations
constexpr double kFastestTurn = 1000;     // rad/s
constexpr double kLargestSeed = 1e15;     // whole numbers up to it are exact
constexpr std::string_view kSwingGroup = "Simulated swing";
constexpr std::string_view kSensorsGroup = "Simulated sensors";

/// The azimuthal rate at which a pendulum circles at a constant tilt.
double conical_psi_rad_s(double theta_rad, const Pendulum<double>& pendulum) {
  return std::sqrt(pendulum.gravity_m_s2 / (pendulum.length_m * std::cos(theta_rad)));
}

double case_psi_rad_s(SwingCase swing_case, double theta_rad, const Pendulum<double>& pendulum) {
  switch (swing_case) {
    case SwingCase::kTwo:
      return kCaseTwoPsi;
    case SwingCase::kConical:
      return conical_psi_rad_s(theta_rad, pendulum);
    default:
      return 0;
  }
}

void add_start_options(CLI::App& command, SimulationOptions& options) {
  const std::string group(kSwingGroup);
  const std::map<std::string, SwingCase> cases{
      {"1", SwingCase::kOne}, {"2", SwingCase::kTwo}, {"conical", SwingCase::kConical}};
  const std::map<std::string, Integrator> integrators{{"euler", Integrator::kEuler},
                                                      {"semi-implicit", Integrator::kSemiImplicit},
                                                      {"dopri5", Integrator::kDopri5}};
  command
      .add_option(
          "--case", options.swing_case,
          "The paper's case 1 (released at rest) or 2 (psi = 2 rad/s), or a conical swing;\n"
          "each at theta = 10 deg, phi = 45 deg unless said otherwise")
      ->transform(CLI::CheckedTransformer(cases).description(""))
      ->type_name("1|2|conical")
      ->default_str("1")
      ->group(group);
  command.add_option("--theta-deg", options.theta_deg, "Tilt from the vertical at the start")
      ->check(number_within(0.0, 179.0))
      ->type_name("DEG")
      ->group(group);
  command.add_option("--phi-deg", options.phi_deg, "Azimuth from the X axis at the start")
      ->check(number_within(-360, 360))
      ->type_name("DEG")
      ->group(group);
  command.add_option("--omega", options.omega_rad_s, "Rate of theta at the start")
      ->check(number_within(-kFastestTurn, kFastestTurn))
      ->type_name("RAD/S")
      ->group(group);
  command.add_option("--psi", options.psi_rad_s, "Rate of phi at the start")
      ->check(number_within(-kFastestTurn, kFastestTurn))
      ->type_name("RAD/S")
      ->group(group);
  CLI::Option* integrator =
      command
          .add_option(
              "--integrator", options.settings.integrator,
              "dopri5: exact; euler: the paper's Eqs. 12 to 19 as printed, one step a sample;\n"
              "semi-implicit: the same with updated velocities")
          ->transform(CLI::CheckedTransformer(integrators).description(""))
          ->type_name("dopri5|euler|semi-implicit")
          ->default_str("dopri5")
          ->group(group);
  command.add_flag("--held", options.held, "The pendulum is held at its start, as by a jig")
      ->excludes(integrator)
      ->group(group);
}

void add_disturbance_options(CLI::App& command, SimulationOptions& options) {
  const std::string group(kSensorsGroup);
  SimulationSettings& settings = options.settings;
  constexpr double kMostVolts = 100;
  const auto number = [&](const std::string& name, double& value, const std::string& help,
                          const std::string& unit, double most) {
    return command.add_option(name, value, help)
        ->check(number_within(0.0, most))
        ->type_name(unit)
        ->capture_default_str()
        ->group(group);
  };
  CLI::Option* ambient = number("--ambient", settings.ambient_v,
                                "What the room's light adds to each signal", "V", kMostVolts);
  CLI::Option* noise =
      number("--noise", settings.noise_v, "RMS noise of each conversion", "V", kMostVolts);
  number("--gap-noise", settings.gap_noise_m, "RMS noise of each sample's gaps", "M", 1);
  CLI::Option* bits = command.add_option("--adc-bits", settings.adc_bits, "The ADC's resolution");
  bits->check(number_within(1, 16))->capture_default_str()->group(group);
  CLI::Option* conversions =
      command.add_option("--conversions", settings.conversions,
                         "Conversions averaged for each lit and each dark reading");
  conversions->check(number_within(1, 4096))->capture_default_str()->group(group);
  command
      .add_flag("--emitter-always-lit", options.emitter_always_lit,
                "A board that cannot switch its emitters: no dark reading")
      ->group(group);
  command
      .add_flag("--ideal", options.ideal,
                "No ambient light, no noise, a 16-bit ADC, one conversion a reading")
      ->excludes(ambient, noise, bits, conversions)
      ->group(group);
  command.add_option("--seed", settings.seed, "Of the noise: one seed, one result")
      ->check(number_within(0, kLargestSeed))
      ->capture_default_str()
      ->group(group);
}

}  // namespace

void add_simulation_options(CLI::App& command, SimulationOptions& options,
                            const std::string& seconds_help) {
  const std::string group(kSwingGroup);
  add_start_options(command, options);
  command.add_option("--seconds", options.seconds, seconds_help)
      ->check(number_within(0.0, 1e9))
      ->type_name("S")
      ->group(group);
  command.add_option("--rate", options.settings.rate_hz, "Samples per second")
      ->check(number_within(0.1, 1e5))
      ->type_name("HZ")
      ->capture_default_str()
      ->group(group);
  add_disturbance_options(command, options);
}

void refuse_simulation_options(const CLI::App& command, const std::string& why,
                               const std::string& but) {
  for (const CLI::Option* option : command.get_options()) {
    const std::string& group = option->get_group();
    if (option->count() > 0 && option->get_name() != but &&
        (group == kSwingGroup || group == kSensorsGroup)) {
      throw CLI::ValidationError(option->get_name(), why);
    }
  }
}

SimulationSettings simulation_settings(const SimulationOptions& options, const Rig<double>& rig) {
  SimulationSettings settings = options.settings;
  const double theta_deg = options.theta_deg.value_or(kCaseThetaDeg);
  const double theta_rad = theta_deg * kRadPerDeg;
  settings.start = {.theta_rad = theta_rad,
                    .phi_rad = options.phi_deg.value_or(kCasePhiDeg) * kRadPerDeg,
                    .omega_rad_s = options.omega_rad_s.value_or(0),
                    .psi_rad_s = options.psi_rad_s.value_or(
                        case_psi_rad_s(options.swing_case, theta_rad, rig.pendulum))};
  settings.duration_s = options.seconds.value_or(
      options.swing_case == SwingCase::kTwo ? kCaseTwoSeconds : kOtherCaseSeconds);
  if (options.swing_case == SwingCase::kConical && theta_deg >= 90) {
    throw CLI::ValidationError("--theta-deg",
                               "no pendulum circles at 90 deg or above, expected less");
  }
  if (settings.integrator != Integrator::kDopri5 && theta_deg == 0) {
    throw CLI::ValidationError("--theta-deg",
                               "the paper's Eqs. 12 to 19 have no answer at 0 deg, expected more; "
                               "--integrator dopri5 has one");
  }
  if (options.held) {
    settings.integrator = Integrator::kHeld;
  }
  settings.emitter_switched = !options.emitter_always_lit;
  if (options.ideal) {
    settings.ambient_v = 0;
    settings.noise_v = 0;
    settings.adc_bits = 16;
    settings.conversions = 1;
  }
  return settings;
}

}  // namespace penduline
