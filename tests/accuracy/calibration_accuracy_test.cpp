// SPDX-License-Identifier: Apache-2.0
// How good the angles are after each method of calibration: many rigs, printed.
#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <vector>

#include "host/calibration/static_calibration.hpp"
#include "host/calibration/swing_calibration.hpp"
#include "tests/accuracy/simulated_unit.hpp"

using namespace penduline;
using namespace penduline::test;

namespace {

constexpr unsigned kRigs = 50;

/// What is measured after the calibration: an ellipse of 11 by 4 deg.
SimulationSettings following(unsigned seed) {
  return settings_for(
      {.theta_rad = 11 * kRadPerDeg, .phi_rad = 20 * kRadPerDeg, .omega_rad_s = 0, .psi_rad_s = 2},
      20, 1000 + seed);
}

/// Prints and returns the RMS over all rigs.
Errors print_all(const std::string& name, const std::vector<Errors>& all) {
  const auto of = [&](double Errors::*member) {
    double squares = 0;
    double worst = 0;
    for (const Errors& errors : all) {
      squares += errors.*member * errors.*member;
      worst = std::max(worst, errors.*member);
    }
    return std::pair(std::sqrt(squares / static_cast<double>(all.size())), worst);
  };
  const auto [gn, gn_worst] = of(&Errors::gn_deg);
  const auto [ekf, ekf_worst] = of(&Errors::ekf_deg);
  fmt::print("{:<28} {} rigs: gn {:.4f} deg RMS (worst {:.4f}), ekf {:.4f} (worst {:.4f})\n", name,
             all.size(), gn, gn_worst, ekf, ekf_worst);
  return {gn, ekf};
}

std::vector<Angles<double>> jig_positions() {
  std::vector<Angles<double>> tilts;
  for (int i = -4; i <= 4; ++i) {
    for (int k = -4; k <= 4; k += 4) {
      tilts.push_back({.theta1_rad = 3.2 * i * kRadPerDeg, .theta2_rad = 3.0 * k * kRadPerDeg});
      tilts.push_back({.theta1_rad = 3.0 * k * kRadPerDeg, .theta2_rad = 3.2 * i * kRadPerDeg});
    }
  }
  return tilts;
}

}  // namespace

TEST_CASE("Without calibration a rig's angles are wrong by degrees") {
  std::vector<Errors> all;
  for (unsigned seed = 1; seed <= kRigs; ++seed) {
    all.push_back(errors_of(typical_rig().rig, real_rig(seed), following(seed)));
  }
  CHECK(print_all("not calibrated", all).gn_deg > 0.5);
}

TEST_CASE("After static points the angles are right to 0.10 deg RMS") {
  std::vector<Errors> all;
  const RigFile start = typical_rig();
  for (unsigned seed = 1; seed <= kRigs; ++seed) {
    const Rig<double> real = real_rig(seed);
    const auto points = held_points(real, start.rig, jig_positions(), 0.03, seed);
    const auto result = calibrate_static(start, points, ResponseModel::kTable);
    REQUIRE(result);
    all.push_back(errors_of(changed(start.rig, result->changes), real, following(seed)));
  }
  const Errors errors = print_all("static, jig 0.03 deg", all);
  CHECK(errors.gn_deg <= 0.10);
  CHECK(errors.ekf_deg <= 0.10);
}

TEST_CASE("After an elliptic free swing of a minute the angles are right to 0.3 deg RMS") {
  std::vector<Errors> all;
  const RigFile start = typical_rig();
  for (unsigned seed = 1; seed <= kRigs; ++seed) {
    const Rig<double> real = real_rig(seed);
    const auto result = calibrate_swing(start, {recorded(real, ellipse(60, seed))}, {});
    REQUIRE(result);
    all.push_back(errors_of(changed(start.rig, result->changes), real, following(seed)));
  }
  const Errors errors = print_all("swing, ellipse of 60 s", all);
  CHECK(errors.gn_deg <= 0.3);
  CHECK(errors.ekf_deg <= 0.3);
}

TEST_CASE("After a release at known angles and half a minute they are right to 0.3 deg RMS") {
  constexpr unsigned kFewer = 10;
  std::vector<Errors> all;
  const RigFile start = typical_rig();
  for (unsigned seed = 1; seed <= kFewer; ++seed) {
    const Rig<double> real = real_rig(seed);
    const SwingStart tilt{.theta_rad = 16 * kRadPerDeg, .phi_rad = 45 * kRadPerDeg};
    const SwingState<double> known = swing_state(tilt);
    const auto result = calibrate_swing(
        start, {recorded(real, settings_for(tilt, 30, seed))},
        {.release = Release{.angles = Angles<double>{known.theta1_rad, known.theta2_rad}}});
    REQUIRE(result);
    all.push_back(errors_of(changed(start.rig, result->changes), real, following(seed)));
  }
  const Errors errors = print_all("swing, released at 16 deg", all);
  CHECK(errors.gn_deg <= 0.3);
  CHECK(errors.ekf_deg <= 0.3);
}
