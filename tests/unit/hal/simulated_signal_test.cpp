// SPDX-License-Identifier: Apache-2.0
// Tests of a simulated sensor's signal: folding back near the disc, the disc's edge and back.
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <utility>

#include "hal/sim/simulated_rig.hpp"
#include "tests/unit/hal/simulated_rigs.hpp"

namespace {

using namespace penduline;
using namespace penduline::test;

/// A TCRT5000's far branch: 1 V at its peak, 2.36 mm, falling beyond.
Response<double> tcrt5000() {
  return {.model = InverseSquareResponse<double>{.a_v_m2 = 1e-4, .b_m = 0.01 - 0.00236, .c_v = 0},
          .nearest_m = 0.00236,
          .farthest_m = 0.03,
          .peak_m = 0.00236};
}

TEST_CASE("Nearer than its peak a TCRT5000's signal falls as the data sheet's does", "[sim]") {
  // Vishay 83760 rev. 1.7, figure 9: relative collector current at 0.5, 1, 2 and 2.36 mm.
  constexpr std::array<std::pair<double, double>, 4> kPoints = {
      {{0.5e-3, 0.641}, {1e-3, 0.833}, {2e-3, 0.991}, {2.36e-3, 1.0}}};
  for (const auto& [gap_m, share] : kPoints) {
    CAPTURE(gap_m);
    CHECK_THAT(sensor_signal_v(tcrt5000(), gap_m), Catch::WithinAbs(share, 0.03));
  }
}

TEST_CASE("The signal has no step at its peak", "[sim]") {
  CHECK_THAT(sensor_signal_v(tcrt5000(), 2.36e-3 - 1e-9),
             Catch::WithinAbs(sensor_signal_v(tcrt5000(), 2.36e-3 + 1e-9), 1e-6));
}

TEST_CASE("From contact to the peak the signal keeps rising", "[sim]") {
  double last_v = 0;
  for (int i = 0; i <= 236; ++i) {
    const double volts = sensor_signal_v(tcrt5000(), i * 1e-5);
    CAPTURE(i);
    REQUIRE(volts > last_v);
    last_v = volts;
  }
}

TEST_CASE("Beyond its peak the signal is the response's", "[sim]") {
  // 1e-4 / 0.02^2
  CHECK(sensor_signal_v(tcrt5000(), 0.01 + 0.00236) == Approx(0.25).epsilon(1e-12));
}

TEST_CASE("A disc pushed into the sensor gives what it gives at contact", "[sim]") {
  CHECK(sensor_signal_v(tcrt5000(), -0.001) == sensor_signal_v(tcrt5000(), 0));
  const Response<double> without_peak{
      .model = LinearResponse<double>{.gap_at_zero_m = 0.012, .slope_m_per_v = -0.006}};
  CHECK(sensor_signal_v(without_peak, -0.001) == Approx(2).epsilon(1e-12));
}

TEST_CASE("A signal is never negative", "[sim]") {
  const Response<double> linear{
      .model = LinearResponse<double>{.gap_at_zero_m = 0.01, .slope_m_per_v = 0.006}};
  CHECK(sensor_signal_v(linear, 0.005) == 0);
}

/// The lit pin of the first sensor, which stands at x, of a pendulum held at an angle.
double pin_v(double x_m, const SwingStart& start) {
  SimulationSettings settings = ideal(start);
  settings.ambient_v = 0.25;
  SimulatedRig rig(rig_with_sensors({{x_m, 0, 0}, {0, 0.02, 0}}), settings);
  rig.advance_to(0);
  return rig.pin_v(0, true);
}

TEST_CASE("A beam that meets the disc gives a signal", "[sim]") {
  CHECK(pin_v(0.059, {}) > 1);
}

TEST_CASE("A beam that misses the disc gives none", "[sim]") {
  // The disc's radius is 60 mm.
  CHECK(pin_v(0.061, {}) == 0.25);
}

TEST_CASE("A tilted disc is narrower for a vertical beam", "[sim]") {
  // 59 mm out lies within 60 mm, but on a disc tilted away by 30 deg the beam lands 80 mm out.
  CHECK(pin_v(0.059, {.theta_rad = 30 * kRadPerDeg, .phi_rad = 180 * kRadPerDeg}) == 0.25);
}

TEST_CASE("A disc that has swung past the horizontal gives no signal", "[sim]") {
  CHECK(pin_v(0.02, {.theta_rad = 89 * kRadPerDeg, .phi_rad = 90 * kRadPerDeg}) >= 0.25);
  CHECK(pin_v(0.02, {.theta_rad = 91 * kRadPerDeg, .phi_rad = 90 * kRadPerDeg}) == 0.25);
  CHECK(pin_v(0.02, {.theta_rad = 170 * kRadPerDeg}) == 0.25);
}

TEST_CASE("An unlit emitter leaves the ambient light", "[sim]") {
  SimulationSettings settings = ideal({});
  settings.ambient_v = 0.25;
  SimulatedRig rig(paper_rig(), settings);
  rig.advance_to(0);
  CHECK(rig.pin_v(0, false) == 0.25);
}

}  // namespace
