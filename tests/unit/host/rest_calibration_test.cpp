// SPDX-License-Identifier: Apache-2.0
#include "host/calibration/rest_calibration.hpp"

#include <catch2/catch.hpp>

#include "tests/accuracy/simulated_unit.hpp"

using namespace penduline;
using namespace penduline::test;

namespace {

/// The typical rig whose first sensor is mounted 0.2 mm higher.
Rig<double> raised() {
  Rig<double> rig = typical_rig().rig;
  rig.layout.position_m[0].z() += 0.2e-3;
  return rig;
}

SignalLog still(const Rig<double>& rig, double theta_deg = 0) {
  return recorded(rig, settings_for({.theta_rad = theta_deg * kRadPerDeg}, 10, 1));
}

std::string error_of(const SignalLog& log) {
  const auto result = calibrate_rest(typical_rig(), {log}, ZeroOf::kHeight);
  return result ? "" : result.error().message;
}

/// What the changed rig reads at rest, in degrees.
double rest_deg(const RigChanges& changes) {
  const Rig<double> rig = changed(typical_rig().rig, changes);
  return rms_deg(Pipeline<double>(rig, SampledRig(raised(), {}).acquisition()), raised(),
                 settings_for({}, 5, 2));
}

}  // namespace

TEST_CASE("A rest zeroes the angles, whatever is said to have changed", "[calibration]") {
  CHECK(rest_deg({}) > 0.3);
  for (const ZeroOf zero_of : {ZeroOf::kHeight, ZeroOf::kResponse, ZeroOf::kGain}) {
    const auto result = calibrate_rest(typical_rig(), {still(raised())}, zero_of);
    REQUIRE(result);
    CHECK(rest_deg(result->changes) < 0.03);
  }
}

TEST_CASE("A rest finds a sensor's height", "[calibration]") {
  const auto result = calibrate_rest(typical_rig(), {still(raised())}, ZeroOf::kHeight);
  REQUIRE(result);
  CHECK(result->changes.positions_m[0]->z() == Approx(-0.0108).margin(2e-6));
  CHECK(result->changes.positions_m[1]->z() == Approx(-0.011).margin(2e-6));
  CHECK(result->record.parameters == std::vector<std::string>{"Sx height_m", "Sy height_m"});
  CHECK(result->record.covariance(0, 0) > 0);
}

TEST_CASE("A rest finds each signal's noise for the Kalman filter", "[calibration]") {
  // 2 mV a conversion, 32 of them lit and 32 dark: 2 mV sqrt(2/32), and the ADC's steps.
  const auto result = calibrate_rest(typical_rig(), {still(raised())}, ZeroOf::kHeight);
  REQUIRE(result);
  CHECK(result->changes.noise_v[0].value() == Approx(0.5e-3).epsilon(0.15));
  CHECK(changed(typical_rig().rig, result->changes).noise[1].volts == Approx(0.5e-3).epsilon(0.15));
}

TEST_CASE("A pendulum that swings a little is not at rest", "[calibration]") {
  CHECK(
      error_of(still(raised(), 0.2))
          .starts_with("rec.csv: the pendulum is not still: sensor Sx sees it move (RMS) by 0.1"));
}

TEST_CASE("A still pendulum is at rest however noisy its gaps, a swing is found beneath the noise",
          "[calibration]") {
  const auto noisy = [](double theta_deg, std::uint64_t seed) {
    SimulationSettings settings = settings_for({.theta_rad = theta_deg * kRadPerDeg}, 20, seed);
    settings.gap_noise_m = 50e-6;  // 0.14 deg
    return error_of(recorded(typical_rig().rig, settings));
  };
  const auto seed = GENERATE(range(1, 9));
  CHECK(noisy(0, static_cast<std::uint64_t>(seed)).empty());
  CHECK_THAT(
      noisy(0.2, static_cast<std::uint64_t>(seed)),
      Catch::Contains("sees it move (RMS) by 0.1") && Catch::EndsWith("wait until it hangs still"));
}

TEST_CASE("A pendulum that turns slowly drifts", "[calibration]") {
  SignalLog log = still(raised());
  for (std::size_t i = 0; i < log.t_s.size(); ++i) {  // once in 8 s
    log.volts[i][1] *= 1 + 0.005 * std::sin(static_cast<double>(i) / 25);
  }
  CHECK_THAT(error_of(log), Catch::Contains("sensor Sy sees it drift by 0.0"));
}

TEST_CASE("A third sensor on the axis is zeroed, too", "[calibration]") {
  RigFile rig = typical_rig();
  rig.rig.layout.count = 3;
  rig.sensor_names.emplace_back("Sz");
  rig.rig.layout.position_m[2] = {0, 0, rig.rig.layout.position_m[0].z()};
  rig.rig.responses[2] = rig.rig.responses[0];
  const SignalLog log = recorded(rig.rig, settings_for({}, 10, 1));
  const auto result = calibrate_rest(rig, {log}, ZeroOf::kHeight);
  REQUIRE(result);
  CHECK(result->changes.positions_m[2]->z() == Approx(-0.011).margin(2e-6));
}

TEST_CASE("Sensors that drift are not at rest", "[calibration]") {
  SignalLog log = still(raised());
  for (std::size_t i = 0; i < log.t_s.size(); ++i) {
    log.volts[i][0] *= 1 + 0.004 * static_cast<double>(i) / static_cast<double>(log.t_s.size());
  }
  CHECK(error_of(log).find("and the sensors warm up") != std::string::npos);
}

TEST_CASE("A drift is seen beside a swing that is too small to matter, and a swing alone is none",
          "[calibration]") {
  SignalLog log = still(raised(), 0.03);  // 0.02 deg RMS
  CHECK(error_of(log).empty());
  for (std::size_t i = 0; i < log.t_s.size(); ++i) {
    log.volts[i][0] *= 1 + 0.004 * static_cast<double>(i) / static_cast<double>(log.t_s.size());
  }
  CHECK_THAT(error_of(log), Catch::Contains("sensor Sx sees it drift by"));
}

TEST_CASE("A few samples are no rest", "[calibration]") {
  SignalLog log = still(raised());
  log.t_s.resize(19);
  log.volts.resize(19);
  CHECK(error_of(log) == "rec.csv: found 19 samples of sensor Sx, expected 20 or more");
}

TEST_CASE("A signal that the response does not have is no rest of this rig", "[calibration]") {
  SignalLog log = still(raised());
  for (auto& volts : log.volts) {
    volts[1] = 0.001;
  }
  CHECK(error_of(log).starts_with("rec.csv: sensor Sy: found 0.0010 V, which is outside"));
}
