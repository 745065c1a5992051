// SPDX-License-Identifier: Apache-2.0
// Lines and parabolas through phases and orientations.
#include "host/analysis/swing_trends.hpp"

#include <cmath>
#include <numbers>

namespace penduline {
namespace {

/// The integral of a quantity of the ellipses over time, by trapezoids, 0 at the first.
template <class Quantity>
Eigen::VectorXd integral(const std::vector<SwingEllipse>& ellipses, const Quantity& quantity) {
  Eigen::VectorXd sums = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(ellipses.size()));
  for (std::size_t i = 1; i < ellipses.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    sums[row] = sums[row - 1] + (quantity(ellipses[i - 1]) + quantity(ellipses[i])) / 2 *
                                    (ellipses[i].t_s - ellipses[i - 1].t_s);
  }
  return sums;
}

/// Values and sigmas of one figure of the ellipses.
struct EllipseColumn {
  Eigen::VectorXd values;
  Eigen::VectorXd sigmas;
};

EllipseColumn column_of(const std::vector<SwingEllipse>& ellipses, Measured SwingEllipse::*figure) {
  const auto rows = static_cast<Eigen::Index>(ellipses.size());
  EllipseColumn column{.values = Eigen::VectorXd(rows), .sigmas = Eigen::VectorXd(rows)};
  for (Eigen::Index i = 0; i < rows; ++i) {
    const Measured& here = ellipses[static_cast<std::size_t>(i)].*figure;
    column.values[i] = here.value;
    column.sigmas[i] = here.sigma;
  }
  return column;
}

Eigen::VectorXd times_of(const std::vector<SwingEllipse>& ellipses) {
  Eigen::VectorXd times(static_cast<Eigen::Index>(ellipses.size()));
  for (Eigen::Index i = 0; i < times.size(); ++i) {
    times[i] = ellipses[static_cast<std::size_t>(i)].t_s - ellipses.front().t_s;
  }
  return times;
}

}  // namespace

double period_ratio(double semi_major_rad, double semi_minor_rad) {
  const double square = semi_major_rad * semi_major_rad;
  return 1 + (square + semi_minor_rad * semi_minor_rad) / 16 +
         square * square * (11.0 / 3072 + square * 173 / 737280);
}

double airy_rate_rad_s(const SwingEllipse& ellipse, double omega0_rad_s) {
  return 3.0 / 8 * omega0_rad_s * ellipse.semi_major_rad.value * ellipse.semi_minor_rad.value;
}

double foucault_rate_rad_s(double latitude_rad) {
  constexpr double kEarthRadPerS = 7.292115e-5;
  return -kEarthRadPerS * std::sin(latitude_rad);
}

std::optional<PeriodTrend> period_trend(const std::vector<SwingEllipse>& ellipses,
                                        double small_period_s) {
  constexpr std::size_t kFewest = 4;
  const EllipseColumn phase = column_of(ellipses, &SwingEllipse::phase_rad);
  if (ellipses.size() < kFewest || !(phase.sigmas.minCoeff() > 0)) {
    return std::nullopt;
  }
  // Phase = phase0 + omega0 (t - c integral of a^2 + b^2): linear in phase0, omega0 and omega0 c.
  Eigen::MatrixXd design(phase.values.size(), 3);
  design << Eigen::VectorXd::Ones(phase.values.size()), times_of(ellipses),
      -integral(ellipses, [](const SwingEllipse& at) { return at.square_rad2(); });
  const LinearFit fit = fit_linear(design, phase.values, phase.sigmas);
  PeriodTrend trend{
      .small_period_s =
          propagated(fit.factors, fit.covariance,
                     [](const Eigen::VectorXd& at) { return 2 * std::numbers::pi / at[1]; }),
      .coefficient_per_rad2 = propagated(fit.factors, fit.covariance,
                                         [](const Eigen::VectorXd& at) { return at[2] / at[1]; }),
      .points = {}};
  for (std::size_t i = 1; i < ellipses.size(); ++i) {
    const SwingEllipse& before = ellipses[i - 1];
    const SwingEllipse& after = ellipses[i];
    const double turned_rad = after.phase_rad.value - before.phase_rad.value;
    const double period_s = 2 * std::numbers::pi * (after.t_s - before.t_s) / turned_rad;
    const double major = (before.semi_major_rad.value + after.semi_major_rad.value) / 2;
    const double minor = (before.semi_minor_rad.value + after.semi_minor_rad.value) / 2;
    trend.points.push_back(
        {.amplitude_rad = std::hypot(major, minor),
         .period_s = {.value = period_s,
                      .sigma = period_s / turned_rad *
                               std::hypot(before.phase_rad.sigma, after.phase_rad.sigma)},
         .theory_s = small_period_s * period_ratio(major, minor)});
  }
  return trend;
}

Measured middle_rate_rad_s(const std::vector<SwingEllipse>& ellipses,
                           const Eigen::VectorXd& angles_rad, const Eigen::VectorXd& sigmas_rad) {
  constexpr Eigen::Index kEnoughForParabola = 5;
  Eigen::VectorXd times = times_of(ellipses);
  times.array() -= times[times.size() - 1] / 2;
  Eigen::MatrixXd design(times.size(), times.size() < kEnoughForParabola ? 2 : 3);
  design.leftCols(2) << Eigen::VectorXd::Ones(times.size()), times;
  if (design.cols() > 2) {
    design.col(2) = times.cwiseAbs2();
  }
  return fit_linear(design, angles_rad, sigmas_rad).factor(1);
}

std::optional<Precession> precession(const std::vector<SwingEllipse>& ellipses,
                                     double omega0_rad_s) {
  constexpr std::size_t kFewest = 3;
  constexpr double kKnownRad = 0.3;
  const EllipseColumn angle = column_of(ellipses, &SwingEllipse::orientation_rad);
  if (ellipses.size() < kFewest || !(angle.sigmas.minCoeff() > 0) ||
      angle.sigmas.maxCoeff() > kKnownRad) {
    return std::nullopt;
  }
  const Eigen::VectorXd by_airy =
      integral(ellipses, [&](const SwingEllipse& at) { return airy_rate_rad_s(at, omega0_rad_s); });
  return Precession{.measured_rad_s = middle_rate_rad_s(ellipses, angle.values, angle.sigmas),
                    .airy_rad_s = middle_rate_rad_s(ellipses, by_airy, angle.sigmas).value};
}

}  // namespace penduline
