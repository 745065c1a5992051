// SPDX-License-Identifier: Apache-2.0
#include "host/analysis/friction_choice.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

using namespace penduline;

namespace {

constexpr double kPeriodS = 1.1;
const double kStiffnessPerS2 = std::pow(2 * 3.14159265358979 / kPeriodS, 2);

/// 30 s of a plane swing of 0.2 rad with the noise of a good encoder.
AngleSeries swing_with(const Friction& friction) {
  std::mt19937 random(5);
  std::normal_distribution<double> noise(0, 2e-4);
  std::vector<double> times;
  for (int i = 0; i < 600; ++i) {
    times.push_back(0.05 * i);
  }
  const SwingModel model{.swing = {.stiffness_1_s2 = kStiffnessPerS2, .friction = friction},
                         .start = {.theta1_rad = 0.2},
                         .zero = {.x_rad = 0.004}};
  AngleSeries series = simulated_angles(model, times, true);
  for (double& angle : series.theta1_rad) {
    angle += noise(random);
  }
  return series;
}

FrictionChoice choice_for(const Friction& friction) {
  const AngleSeries series = swing_with(friction);
  const auto linear = fit_from_nothing(series, kPeriodS);
  REQUIRE(linear);
  const auto choice = choose_friction(series, *linear);
  REQUIRE(choice);
  return *choice;
}

/// Whether a fitted figure is its truth within three of its sigmas, which are small beside it.
void check_figure(const SwingFit& fit, double Friction::*term, double truth) {
  const Measured figure =
      fit.figure([&](const SwingModel& model) { return model.swing.friction.*term; });
  CHECK(figure.sigma < truth / 10);
  CHECK(std::abs(figure.value - truth) < 3 * figure.sigma);
}

}  // namespace

TEST_CASE("Linear friction alone is found alone") {
  const FrictionChoice choice = choice_for({.linear_per_s = 0.05});
  CHECK(name_of(choice.chosen.terms) == "linear");
  check_figure(choice.chosen, &Friction::linear_per_s, 0.05);
  CHECK(choice.linear.probability < 1e-6);
  CHECK(choice.dry.probability > 1e-3);
}

TEST_CASE("Quadratic friction alone is found alone") {
  const FrictionChoice choice = choice_for({.quadratic_per_rad = 0.15});
  CHECK(name_of(choice.chosen.terms) == "quadratic");
  check_figure(choice.chosen, &Friction::quadratic_per_rad, 0.15);
}

TEST_CASE("Dry friction alone is found alone") {
  const FrictionChoice choice = choice_for({.dry_rad_s2 = 0.04});
  CHECK(name_of(choice.chosen.terms) == "dry");
  check_figure(choice.chosen, &Friction::dry_rad_s2, 0.04);
  CHECK(choice.dry.probability < 1e-6);
  CHECK_FALSE(choice.candidates[1].supported);
}

TEST_CASE("Dry friction beside linear friction is found, and both come back", "[long]") {
  const FrictionChoice choice = choice_for({.linear_per_s = 0.05, .dry_rad_s2 = 0.04});
  CHECK(name_of(choice.chosen.terms) == "linear + dry");
  check_figure(choice.chosen, &Friction::linear_per_s, 0.05);
  check_figure(choice.chosen, &Friction::dry_rad_s2, 0.04);
}

TEST_CASE("A swing that keeps its amplitude supports no friction") {
  CHECK(name_of(choice_for({}).chosen.terms) == "none");
}

TEST_CASE("Length and rest are found with the friction") {
  const SwingFit fit = choice_for({.linear_per_s = 0.05}).chosen;
  CHECK(fit.model.swing.stiffness_1_s2 == Approx(kStiffnessPerS2).epsilon(1e-5));
  CHECK(fit.model.zero.x_rad == Approx(0.004).margin(3e-5));
  CHECK(fit.noise.x_rad == Approx(2e-4).epsilon(0.1));
}
