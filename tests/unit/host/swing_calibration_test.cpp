// SPDX-License-Identifier: Apache-2.0
#include "host/calibration/swing_calibration.hpp"

#include <catch2/catch.hpp>

#include "tests/accuracy/simulated_unit.hpp"

using namespace penduline;
using namespace penduline::test;

namespace {

std::string error_of(const SignalLog& log, const SwingOptions& options = {}) {
  const auto result = calibrate_swing(typical_rig(), {log}, options);
  return result ? "" : result.error().message;
}

SignalLog planar(double theta_deg, double phi_deg, double seconds) {
  return recorded(real_rig(3), settings_for({.theta_rad = theta_deg * kRadPerDeg,
                                             .phi_rad = phi_deg * kRadPerDeg},
                                            seconds, 1));
}

}  // namespace

TEST_CASE("An elliptic swing of half a minute calibrates sensors that nobody measured",
          "[calibration]") {
  const Rig<double> real = real_rig(3);
  const auto result = calibrate_swing(typical_rig(), {recorded(real, ellipse(30, 3))}, {});
  REQUIRE(result);
  const Rig<double> calibrated = changed(typical_rig().rig, result->changes);
  const Errors errors = errors_of(calibrated, real, ellipse(10, 4));
  CHECK(errors.gn_deg < 0.3);
  CHECK(errors.ekf_deg < 0.3);
  CHECK(result->record.values[0] == Approx(real.pendulum.length_m).epsilon(2e-4));
  CHECK(result->record.residual_m < 30e-6);
  CHECK(calibrated.responses[0].nearest_m > 0.003);
  CHECK(calibrated.responses[0].farthest_m < 0.016);
}

TEST_CASE("Frictions are 0 or more; one at 0 is held there, and that is said", "[calibration]") {
  Rig<double> real = real_rig(3);
  real.pendulum.damping_per_s = 0;
  const auto result = calibrate_swing(typical_rig(), {recorded(real, ellipse(20, 3))}, {});
  REQUIRE(result);
  std::string held;
  for (Eigen::Index i = 1; i < 4; ++i) {
    CAPTURE(result->record.parameters[static_cast<std::size_t>(i)], result->record.values[i]);
    CHECK(result->record.values[i] >= 0);
    CHECK((result->record.covariance(i, i) == 0) == (result->record.values[i] == 0));
    if (result->record.values[i] == 0) {
      held += (held.empty() ? "" : ", ") + result->record.parameters[static_cast<std::size_t>(i)];
    }
  }
  REQUIRE_FALSE(held.empty());
  CHECK(result->notes.back() == "held at 0, for less than none is no friction: " + held);
  CHECK(result->record.covariance(0, 0) > 0);
}

TEST_CASE("A swing in a plane across both sensors does not tell its angles",
          "[calibration][long]") {
  CHECK(error_of(planar(12, 45, 20)).find("leaves its amplitude uncertain by ") !=
        std::string::npos);
}

TEST_CASE("A swing that one sensor hardly sees is refused, and what to do is said",
          "[calibration]") {
  const std::string error = error_of(planar(10, 0, 20));
  CHECK(error.find("sensor Sy: found gaps from ") != std::string::npos);
  CHECK(error.find("let it swing in an ellipse") != std::string::npos);
}

TEST_CASE("A swing through the fold is refused, and said how much of it", "[calibration]") {
  const std::string error = error_of(planar(30, 0, 20));
  INFO(error);
  CHECK(error.starts_with("rec.csv: sensor Sx: "));
  CHECK(error.find("% of the samples are at the fold of its response or beside it, nearer than "
                   "3.00 mm") != std::string::npos);
}

TEST_CASE("A pendulum that hangs still, or for moments only, is no swing", "[calibration]") {
  CHECK(error_of(planar(0.3, 45, 20)).find("expected 1 deg or more") != std::string::npos);
  CHECK(error_of(planar(10, 45, 4)) ==
        "rec.csv: found 3.6 periods of the swing, expected 5 or more");
}

TEST_CASE("A hand that stops the pendulum is no free swing", "[calibration][long]") {
  SignalLog log = recorded(real_rig(3), ellipse(20, 1));
  for (std::size_t i = log.t_s.size() / 2; i < log.t_s.size(); ++i) {
    log.volts[i] = log.volts[log.t_s.size() / 2];
  }
  CHECK_FALSE(error_of(log).empty());
}

TEST_CASE("A sensor that is another by far is refused", "[calibration]") {
  SignalLog log = recorded(real_rig(3), ellipse(20, 1));
  for (auto& volts : log.volts) {
    volts[0] *= 0.01;
  }
  CHECK(error_of(log).find("start from a rig with a typical response") != std::string::npos);
}
