// SPDX-License-Identifier: Apache-2.0
#include "host/analysis/swing_trends.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "hal/sim/motion.hpp"
#include "host/units.hpp"

using namespace penduline;

namespace {

constexpr Pendulum<double> kPendulum{.length_m = 0.3, .gravity_m_s2 = 9.8};
const double kOmega0RadPerS = std::sqrt(9.8 / 0.3);

/// 20 s of a frictionless swing at 20 Hz; its major axis lies along X at the start.
AngleSeries frictionless(double major_rad, double minor_rad) {
  const auto motion = make_motion(
      Integrator::kDopri5,
      {.theta_rad = major_rad, .psi_rad_s = minor_rad * kOmega0RadPerS / std::sin(major_rad)},
      kPendulum, 0.05);
  AngleSeries series;
  for (int i = 0; i <= 400; ++i) {
    motion->advance_to(0.05 * i);
    series.t_s.push_back(0.05 * i);
    series.theta1_rad.push_back(motion->state().theta1_rad);
    series.theta2_rad.push_back(motion->state().theta2_rad);
  }
  return series;
}

std::vector<SwingEllipse> ellipses_of(const AngleSeries& series) {
  const double period_s = 2 * std::numbers::pi / kOmega0RadPerS;
  return swing_ellipses(series, {.period_s = period_s,
                                 .step_s = period_s,
                                 .rest = TiltPoint{},
                                 .noise = TiltPoint{.x_rad = 1e-3, .y_rad = 1e-3}});
}

}  // namespace

TEST_CASE("A plane swing's period rises as SciPy's elliptic integral says") {
  // 2/pi scipy.special.ellipk(sin(amplitude/2)^2)
  CHECK(period_ratio(5 * kDegree, 0) == Approx(1.0004761725).epsilon(1e-9));
  CHECK(period_ratio(15 * kDegree, 0) == Approx(1.0043005792).epsilon(1e-8));
  CHECK(period_ratio(30 * kDegree, 0) == Approx(1.0174087976).epsilon(1e-6));
}

TEST_CASE("The measured precession is the integrated one within 1 % up to 15 deg") {
  // Turn of the highest points over 20 s, scipy.integrate.solve_ivp(method="DOP853", rtol=1e-12) of
  // the pendulum in Cartesian coordinates, in rad/s.
  struct Truth {
    double major_deg;
    double rate_rad_s;
  };
  for (const auto& [major_deg, rate_rad_s] :
       {Truth{5, 0.005438140}, Truth{10, 0.021721458}, Truth{15, 0.048756500}}) {
    const auto ellipses = ellipses_of(frictionless(major_deg * kDegree, major_deg / 3 * kDegree));
    const auto found = precession(ellipses, kOmega0RadPerS);
    REQUIRE(found);
    CHECK(found->measured_rad_s.value == Approx(rate_rad_s).epsilon(0.01));
    CHECK(found->airy_rad_s == Approx(rate_rad_s).epsilon(0.01));
  }
}

TEST_CASE("An ellipse that is passed through the other way turns the other way") {
  const auto found =
      precession(ellipses_of(frictionless(15 * kDegree, -5 * kDegree)), kOmega0RadPerS);
  REQUIRE(found);
  CHECK(found->measured_rad_s.value == Approx(-0.048756500).epsilon(0.01));
}

TEST_CASE("A circle has no precession to be measured") {
  const double conical = std::sin(10 * kDegree) / std::sqrt(std::cos(10 * kDegree));
  CHECK_FALSE(
      precession(ellipses_of(frictionless(10 * kDegree, conical)), kOmega0RadPerS).has_value());
}

TEST_CASE("A pendulum in Paris turns by 271 degrees a day, clockwise") {
  CHECK(foucault_rate_rad_s(48.846 * kDegree) * 86164.1 / kDegree ==
        Approx(-360 * std::sin(48.846 * kDegree)).epsilon(1e-6));
  CHECK(foucault_rate_rad_s(-90 * kDegree) > 0);
}

TEST_CASE("The period's rise with the amplitude is found from phases alone") {
  const double omega0_rad_s = 6;
  std::vector<SwingEllipse> ellipses;
  double phase_rad = 0.4;
  double square = 0.09;
  for (int i = 0; i < 30; ++i) {
    ellipses.push_back({.t_s = 1.0 * i,
                        .semi_major_rad = {.value = std::sqrt(square), .sigma = 1e-3},
                        .semi_minor_rad = {},
                        .orientation_rad = {},
                        .phase_rad = {.value = phase_rad, .sigma = 1e-3},
                        .centre = {}});
    const double next = square * 0.9;
    phase_rad += omega0_rad_s * (1 - (square + next) / 2 / 16);
    square = next;
  }
  const auto trend = period_trend(ellipses, 2 * std::numbers::pi / omega0_rad_s);
  REQUIRE(trend);
  CHECK(trend->small_period_s.value == Approx(2 * std::numbers::pi / omega0_rad_s).epsilon(1e-9));
  CHECK(trend->coefficient_per_rad2.value == Approx(1.0 / 16).epsilon(1e-6));
  CHECK(trend->points.size() == 29);
  CHECK(trend->points[0].amplitude_rad == Approx((0.3 + std::sqrt(0.081)) / 2));
}
