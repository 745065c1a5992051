// SPDX-License-Identifier: Apache-2.0
// Residuals, how they repeat themselves, and the delay that would make them smaller.
#include "host/analysis/comparison.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace penduline {

Comparison compare_with_simulation(const AngleSeries& series, const SwingFit& fit) {
  Comparison result;
  const auto count1 = fit.residual1_rad.size();
  const auto count = count1 + fit.residual2_rad.size();
  Eigen::VectorXd all(count);
  all << fit.residual1_rad, fit.residual2_rad;
  result.rms_rad = std::sqrt(all.squaredNorm() / static_cast<double>(count));
  Eigen::Index where = 0;
  result.max_rad = all.cwiseAbs().maxCoeff(&where);
  result.max_at_s = series.t_s[static_cast<std::size_t>(where % count1)];
  const auto correlation = [&](Eigen::Index lag) {
    const double first = autocorrelation(fit.residual1_rad, lag);
    return fit.planar ? first : (first + autocorrelation(fit.residual2_rad, lag)) / 2;
  };
  result.next_correlation = correlation(1);
  const auto period_rows = static_cast<Eigen::Index>(
      2 * std::numbers::pi / std::sqrt(fit.model.swing.stiffness_1_s2) / series.period_s());
  for (Eigen::Index lag = 1; lag <= std::min(period_rows, count1 - 1); ++lag) {
    if (std::abs(correlation(lag)) > std::abs(result.most_correlation)) {
      result.most_correlation = correlation(lag);
      result.most_correlation_lag_s = static_cast<double>(lag) * series.period_s();
    }
  }
  result.white_limit = 2 / std::sqrt(static_cast<double>(count));
  result.repetition = fit.repetition;
  // residual = -rate delay.
  Eigen::MatrixXd rates(count, 1);
  const auto path = swing_path(fit.model.swing, fit.model.start, series.t_s);
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto& state = path[static_cast<std::size_t>(i % count1)];
    rates(i, 0) = i < count1 ? -state.omega1_rad_s : -state.omega2_rad_s;
  }
  result.delay_s =
      fit_linear(rates, all, Eigen::VectorXd::Constant(count, std::max(result.rms_rad, 1e-12)))
          .factor(0);
  result.delay_s.sigma *= std::sqrt(fit.repetition);
  return result;
}

}  // namespace penduline
