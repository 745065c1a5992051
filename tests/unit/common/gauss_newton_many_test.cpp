// SPDX-License-Identifier: Apache-2.0
// Tests of Gauss-Newton with three, four and eight sensors: exact gaps, noise, least squares.
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "common/gauss_newton.hpp"
#include "tests/unit/common/test_rig.hpp"

namespace penduline::test {
namespace {

using Gaps = std::array<double, kMaxSensors>;

/// At odd places and heights, in no order.
template <class Scalar>
SensorLayout<Scalar> odd_layout(std::size_t count) {
  auto layout = layout_of<Scalar>({{0.021, 0.003, 0.001},
                                   {-0.004, 0.026, -0.002},
                                   {-0.018, -0.009, 0.003},
                                   {0.007, -0.022, 0},
                                   {0.031, 0.028, 0.004},
                                   {-0.025, 0.017, -0.001},
                                   {0.011, 0.009, 0.002},
                                   {-0.003, -0.034, 0.0005}},
                                  0.025);
  layout.count = count;
  return layout;
}

/// Every 3 degrees of both angles to +-30 degrees, where the odd layouts are well conditioned.
template <class Visitor>
void for_each_tilt(const Visitor& visit) {
  for (int i = -30; i <= 30; i += 3) {
    for (int j = -30; j <= 30; j += 3) {
      visit(Angles<double>{from_degrees(i), from_degrees(j)});
    }
  }
}

/// Fixed errors of a few tenths of a millimetre, twice what a sensor's noise would be.
Gaps with_noise(Gaps gap_m) {
  constexpr Gaps kNoise = {180e-6, -240e-6, 90e-6, 310e-6, -150e-6, 60e-6, -270e-6, 220e-6};
  for (std::size_t i = 0; i < kMaxSensors; ++i) {
    gap_m[i] += kNoise[i];
  }
  return gap_m;
}

/// The misfit of every gap, by the test's own forward model.
Eigen::VectorXd misfit_m(const SensorLayout<double>& layout, const Gaps& gap_m,
                         const Slopes<double>& slopes) {
  const Gaps fitted_m = gaps_at(layout, angles_of(slopes));
  Eigen::VectorXd misfit(static_cast<Eigen::Index>(layout.count));
  for (std::size_t i = 0; i < layout.count; ++i) {
    misfit[static_cast<Eigen::Index>(i)] = gap_m[i] - fitted_m[i];
  }
  return misfit;
}

/// Cosine of the angle between the misfit and what the slopes can mend: 0 at a minimum.
double mendable(const SensorLayout<double>& layout, const Gaps& gap_m,
                const Slopes<double>& slopes) {
  const Eigen::VectorXd misfit = misfit_m(layout, gap_m, slopes);
  const double secant = std::sqrt(1 + slopes.a * slopes.a + slopes.b * slopes.b);
  Eigen::MatrixX2d jacobian(misfit.size(), 2);
  for (std::size_t i = 0; i < layout.count; ++i) {
    jacobian.row(static_cast<Eigen::Index>(i))
        << layout.position_m[i].x() - layout.disc_offset_m * slopes.a / secant,
        layout.position_m[i].y() - layout.disc_offset_m * slopes.b / secant;
  }
  return (jacobian.transpose() * misfit).norm() / (jacobian.norm() * misfit.norm());
}

TEST_CASE("Three, four and eight sensors at odd places and heights give the angles back",
          "[gauss_newton]") {
  const std::size_t count = GENERATE(3U, 4U, 8U);
  const auto layout = odd_layout<double>(count);
  const GaussNewton<double> inverse(layout);
  Worst worst;
  for_each_tilt([&](const Angles<double>& angles) {
    const auto result = inverse.solve(gaps_at(layout, angles));
    REQUIRE(result.has_value());
    worst.note(angle_error(result->slopes, angles));
  });
  CAPTURE(count);
  CHECK(worst.value() <= 1e-12);
}

TEST_CASE("In float three, four and eight sensors are within 5e-7 rad of double",
          "[gauss_newton]") {
  const std::size_t count = GENERATE(3U, 4U, 8U);
  Worst worst;
  for_each_tilt([&](const Angles<double>& angles) {
    worst.note(float_error(odd_layout<float>(count), angles));
  });
  CAPTURE(count);
  CHECK(worst.value() <= 5e-7);
}

TEST_CASE("Gaps that disagree give SciPy's least squares", "[gauss_newton]") {
  const auto layout = odd_layout<double>(4);
  const std::array<double, 4> gap_m = {0.020705, 0.02021, 0.037355, 0.029525};
  const auto result = GaussNewton<double>(layout).solve(gap_m);
  REQUIRE(result.has_value());
  // scipy.optimize.root of the gradient of the squared misfit, from where
  // scipy.optimize.least_squares stops 4e-10 away
  CHECK_THAT(result->slopes.a, Catch::WithinAbs(0.3084058644767393, 1e-12));
  CHECK_THAT(result->slopes.b, Catch::WithinAbs(0.22383725496053572, 1e-12));
}

TEST_CASE("With noise the answer is the minimum of the squared misfit", "[gauss_newton]") {
  const std::size_t count = GENERATE(3U, 4U, 8U);
  const auto layout = odd_layout<double>(count);
  const GaussNewton<double> inverse(layout);
  Worst worst;
  for_each_tilt([&](const Angles<double>& angles) {
    const Gaps gap_m = with_noise(gaps_at(layout, angles));
    const auto result = inverse.solve(gap_m);
    REQUIRE(result.has_value());
    worst.note(mendable(layout, gap_m, result->slopes));
  });
  CAPTURE(count);
  CHECK(worst.value() <= 1e-10);
}

TEST_CASE("The residual is the RMS of the gaps' misfit", "[gauss_newton]") {
  const std::size_t count = GENERATE(3U, 4U, 8U);
  const auto layout = odd_layout<double>(count);
  const GaussNewton<double> inverse(layout);
  Worst worst;
  for_each_tilt([&](const Angles<double>& angles) {
    const Gaps gap_m = with_noise(gaps_at(layout, angles));
    const auto result = inverse.solve(gap_m);
    const double rms_m =
        misfit_m(layout, gap_m, result->slopes).norm() / std::sqrt(static_cast<double>(count));
    worst.note(result->residual_m / rms_m - 1);
  });
  CAPTURE(count);
  CHECK(worst.value() <= 1e-10);
}

TEMPLATE_TEST_CASE("Gaps whose misfit is too large for its square are no answer", "[gauss_newton]",
                   float, double) {
  // Four sensors in a cross see the same: no slope follows from that, and all of it is misfit.
  const auto cross =
      layout_of<TestType>({{0.02, 0, 0}, {-0.02, 0, 0}, {0, 0.02, 0}, {0, -0.02, 0}}, 0.02);
  std::array<TestType, 4> gap_m{};
  gap_m.fill(2 * std::sqrt(std::numeric_limits<TestType>::max()));
  CHECK_FALSE(GaussNewton<TestType>(cross).solve(gap_m).has_value());
}

}  // namespace
}  // namespace penduline::test
