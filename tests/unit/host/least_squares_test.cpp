// SPDX-License-Identifier: Apache-2.0
#include "host/fit/least_squares.hpp"

#include <catch2/catch.hpp>
#include <cmath>

using penduline::fit_least_squares;
using penduline::FitParameter;

namespace {

// NIST's Misra1a (Statistical Reference Datasets): y = b1 (1 - exp(-b2 x)).
constexpr std::array<double, 14> kY = {10.07, 14.73, 17.94, 23.93, 29.61, 35.18, 40.02,
                                       44.82, 50.76, 55.05, 61.01, 66.40, 75.47, 81.78};
constexpr std::array<double, 14> kX = {77.6,  114.9, 141.1, 190.8, 239.9, 289.0, 332.8,
                                       378.4, 434.8, 477.3, 536.8, 593.1, 689.1, 760.0};

void misra1a(const Eigen::VectorXd& b, Eigen::VectorXd& residuals) {
  for (std::size_t i = 0; i < kX.size(); ++i) {
    residuals[static_cast<Eigen::Index>(i)] = b[0] * (1 - std::exp(-b[1] * kX[i])) - kY[i];
  }
}

}  // namespace

TEST_CASE("NIST's Misra1a is fitted to its certified values") {
  const auto fit = fit_least_squares(
      {{.name = "b1", .start = 500, .scale = 100}, {.name = "b2", .start = 1e-4, .scale = 1e-4}},
      kX.size(), misra1a);
  REQUIRE(fit);
  CHECK(fit->values[0] == Approx(2.3894212918e2).epsilon(1e-6));
  CHECK(fit->values[1] == Approx(5.5015643181e-4).epsilon(1e-6));
  CHECK(fit->sigma(0) == Approx(2.7070075241).epsilon(1e-4));
  CHECK(fit->sigma(1) == Approx(7.2668688436e-6).epsilon(1e-4));
  CHECK(fit->scatter == Approx(1.0187876330e-1).epsilon(1e-6));
}

TEST_CASE("A parameter stays within its bounds, and one that would go on is named") {
  const auto fit = fit_least_squares({{.name = "b1", .start = 210, .scale = 100, .high = 220},
                                      {.name = "b2", .start = 1e-4, .scale = 1e-4}},
                                     kX.size(), misra1a);
  REQUIRE(fit);
  CHECK(fit->values[0] == Approx(220));
  CHECK(fit->at_bound == std::vector<std::size_t>{0});
}

TEST_CASE(
    "What is held at its bound is not uncertain, and the others are known as if it were given") {
  const auto held = fit_least_squares({{.name = "b1", .start = 210, .scale = 100, .high = 220},
                                       {.name = "b2", .start = 1e-4, .scale = 1e-4}},
                                      kX.size(), misra1a);
  const auto alone = fit_least_squares({{.name = "b2", .start = 1e-4, .scale = 1e-4}}, kX.size(),
                                       [](const Eigen::VectorXd& b2, Eigen::VectorXd& residuals) {
                                         misra1a(Eigen::Vector2d(220, b2[0]), residuals);
                                       });
  REQUIRE(held);
  REQUIRE(alone);
  CHECK(held->sigma(0) == 0);
  CHECK(held->covariance(0, 1) == 0);
  // One more degree of freedom.
  CHECK(held->sigma(1) == Approx(alone->sigma(0) * std::sqrt(13.0 / 12)).epsilon(1e-4));
}

TEST_CASE("A number that the data do not see is named as undetermined") {
  const auto sum_only = [](const Eigen::VectorXd& values, Eigen::VectorXd& residuals) {
    residuals.setConstant(values[0] + values[1] - 3);
    residuals[0] += 0.1;
  };
  const auto fit = fit_least_squares(
      {{.name = "a", .coarsest_sigma = 0.5}, {.name = "b", .coarsest_sigma = 0.5}}, 10, sum_only);
  REQUIRE(fit);
  CHECK(fit->undetermined == std::vector<std::size_t>{0, 1});
}

TEST_CASE("Fewer measurements than unknowns are refused") {
  const auto fit =
      fit_least_squares({{.name = "a"}, {.name = "b"}}, 1,
                        [](const auto&, Eigen::VectorXd& residuals) { residuals[0] = 0; });
  REQUIRE_FALSE(fit);
  CHECK(fit.error().message == "found 1 measurements for 2 unknowns, expected at least as many");
}

TEST_CASE("A first guess without an answer is said") {
  const auto fit = fit_least_squares(
      {{.name = "a"}}, 2,
      [](const auto&, Eigen::VectorXd& residuals) { residuals.setConstant(NAN); });
  REQUIRE_FALSE(fit);
  CHECK(fit.error().message == "the fit's first guess has no answer");
}

TEST_CASE(
    "Of two numbers that a line hardly tells apart one comes to its bound, the other to its best") {
  // y = a x + b (x + x^2/100) with a, b >= 0 and data that would like b below 0.
  const auto line = [](const Eigen::VectorXd& at, Eigen::VectorXd& residuals) {
    for (Eigen::Index i = 0; i < residuals.size(); ++i) {
      const double x = 0.1 * static_cast<double>(i);
      residuals[i] = at[0] * x + at[1] * (x + x * x / 100) - (2 * x - x * x / 50);
    }
  };
  const auto fit = fit_least_squares({{.name = "a", .start = 1, .scale = 1, .low = 0},
                                      {.name = "b", .start = 1, .scale = 1, .low = 0}},
                                     20, line);
  REQUIRE(fit);
  // numpy.polyfit's slope through the origin: sum(x y) / sum(x^2)
  CHECK(fit->values[0] == Approx(1.9707692308).epsilon(1e-6));
  CHECK(fit->values[1] == Approx(0).margin(1e-9));
  CHECK(fit->at_bound == std::vector<std::size_t>{1});
}
