// SPDX-License-Identifier: Apache-2.0
// The pendulum's own path as the yardstick of its sensors.
#include "host/calibration/signal_fit.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "host/calibration/swing_problem.hpp"

namespace penduline {
namespace {

double longest_s(const std::vector<SwingData>& swings) {
  double longest = 0;
  for (const SwingData& swing : swings) {
    longest = std::max(longest, swing.t_s.back() - swing.t_s.front());
  }
  return longest;
}

tl::expected<Fit, Error> fit_from(SwingProblem& problem, const Eigen::VectorXd& values) {
  std::vector<FitParameter> parameters;
  for (std::size_t i = 0; i < problem.unknowns().size(); ++i) {
    parameters.push_back(problem.unknowns()[i].parameter);
    parameters.back().start = values[static_cast<Eigen::Index>(i)];
  }
  return fit_least_squares(parameters, problem.residual_count(),
                           [&](const Eigen::VectorXd& at, Eigen::VectorXd& residuals) {
                             problem.residuals(at, residuals);
                           });
}

/// What is left of one sensor's signals: noise, and what the model itself is wrong by.
class Leftover {
 public:
  void take(double gap_m, double misfit_v) { misfits_.emplace_back(gap_m, misfit_v); }

  /// Sigma for each signal, such that a mean over signals of about one gap is as uncertain as it
  /// is: what the model is wrong by there no number of samples takes away.
  [[nodiscard]] double sigma_v() const {
    constexpr double kLeastV = 20e-6;
    std::array<double, kBins> sums{};
    std::array<double, kBins> counts{};
    double squares = 0;
    const auto [nearest, farthest] = std::ranges::minmax_element(misfits_);
    for (const auto& [gap_m, misfit_v] : misfits_) {
      const double share = (gap_m - nearest->first) / (farthest->first - nearest->first);
      const auto bin = static_cast<std::size_t>(std::clamp(share, 0.0, 0.999) * kBins);
      sums[bin] += misfit_v;
      counts[bin] += 1;
      squares += misfit_v * misfit_v;
    }
    double mean_squares = 0;  // of the bins' means, each as often as it has signals
    for (std::size_t i = 0; i < kBins; ++i) {
      mean_squares += counts[i] > 0 ? sums[i] * sums[i] / counts[i] : 0;
    }
    const auto count = static_cast<double>(misfits_.size());
    const double a_bin = count / kBins;
    // Noise alone leaves kBins times its variance in `mean_squares`.
    const double noise = std::max(0.0, squares - mean_squares) / std::max(1.0, count - kBins);
    const double wrong = std::max(0.0, mean_squares - kBins * noise) / count;
    return std::max(kLeastV, std::sqrt(noise + a_bin * wrong));
  }
  [[nodiscard]] bool empty() const { return misfits_.empty(); }

 private:
  static constexpr std::size_t kBins = 16;
  std::vector<std::pair<double, double>> misfits_;
};

/// What is left of each sensor's signal becomes what its residuals are divided by.
void learn_noise(SwingProblem& problem, const Eigen::VectorXd& values) {
  std::array<Leftover, kMaxSensors> left;
  for (const Place& place : problem.places()) {
    left[place.sensor].take(problem.gap_m(values, place), problem.misfit_v(values, place));
  }
  for (std::size_t i = 0; i < kMaxSensors; ++i) {
    if (!left[i].empty()) {
      problem.set_sigma_v(i, left[i].sigma_v());
    }
  }
}

/// Sigma of an amplitude sqrt(theta^2 + (rate/omega)^2), of either axis.
double amplitude_sigma_rad(const SwingProblem& problem, const Fit& fit, const SwingData& swing,
                           std::size_t index, double omega) {
  double worst = 0;
  const auto first = static_cast<Eigen::Index>(problem.first_of_swing(index));
  for (Eigen::Index axis = 0; axis < 2; ++axis) {
    const double angle = fit.values[first + axis];
    if (swing.release) {
      worst = std::max(worst, fit.sigma(static_cast<std::size_t>(first + axis)));
      continue;
    }
    const double rate = fit.values[first + 2 + axis] / omega;
    const double amplitude = std::hypot(angle, rate);
    const Eigen::Vector2d along(angle / amplitude, rate / amplitude / omega);
    Eigen::Matrix2d covariance;
    covariance << fit.covariance(first + axis, first + axis),
        fit.covariance(first + axis, first + 2 + axis),
        fit.covariance(first + 2 + axis, first + axis),
        fit.covariance(first + 2 + axis, first + 2 + axis);
    worst = std::max(worst, std::sqrt(along.dot(covariance * along)));
  }
  return worst;
}

void tell(SwingProblem& problem, const std::vector<SwingData>& swings, const SensorModel& sensors,
          SignalFit& result) {
  const Eigen::VectorXd& values = result.fit.values;
  double squares = 0;
  for (const Place& place : problem.places()) {
    constexpr double kStepM = 1e-6;
    const std::span<const double> numbers = problem.sensor_numbers(values);
    const double gap_m = problem.gap_m(values, place);
    const double steepness = (sensors.volts(numbers, place.sensor, gap_m + kStepM) -
                              sensors.volts(numbers, place.sensor, gap_m - kStepM)) /
                             (2 * kStepM);
    const double misfit_m = problem.misfit_v(values, place) / steepness;
    result.used[place.sensor].push_back(
        {.gap_m = gap_m,
         .volts = swings[place.swing].volts[place.sample][place.sensor],
         .misfit_m = misfit_m});
    squares += misfit_m * misfit_m;
  }
  result.residual_m = std::sqrt(squares / static_cast<double>(problem.places().size()));
  for (const Unknown& unknown : problem.unknowns()) {
    result.names.push_back(unknown.parameter.name);
  }
  result.first_sensor_number = problem.first_sensor_number();
}

}  // namespace

tl::expected<SignalFit, Error> fit_signals(const Pendulum<double>& pendulum, double length_share,
                                           const std::vector<SwingData>& swings,
                                           const SensorModel& sensors) {
  constexpr double kFirstPeriods = 3;
  constexpr double kGrowth = 4;
  SwingProblem problem(pendulum, length_share, swings, sensors);
  const std::vector<double> start = problem.start_values();
  Eigen::VectorXd values = Eigen::Map<const Eigen::VectorXd>(start.data(), std::ssize(start));
  SignalFit result;
  const double end_s = longest_s(swings);
  double window_s = kFirstPeriods / small_swing_hz(pendulum);
  problem.choose(window_s, nullptr);
  // The last round weighs the sensors by the noise that the one before has left.
  for (int last_rounds = 0; last_rounds < 2;) {
    auto fit = fit_from(problem, values);
    if (!fit) {
      return tl::unexpected(fit.error());
    }
    values = fit->values;
    result.fit = std::move(*fit);
    if (window_s >= end_s) {
      ++last_rounds;
    }
    if (last_rounds < 2) {
      learn_noise(problem, values);
      window_s = window_s * kGrowth > end_s / 2 ? std::max(end_s, window_s) : window_s * kGrowth;
      result.left_out = problem.choose(window_s, &values);
    }
  }
  // The sigmas were learned from what is left, and hold more than its scatter.
  result.fit.covariance /= std::min(1.0, result.fit.scatter * result.fit.scatter);
  tell(problem, swings, sensors, result);
  const double omega = std::sqrt(pendulum.gravity_m_s2 / values[0]);
  for (std::size_t i = 0; i < swings.size(); ++i) {
    result.angle_sigma_rad = std::max(
        result.angle_sigma_rad, amplitude_sigma_rad(problem, result.fit, swings[i], i, omega));
    if (swings[i].release) {
      result.release_s = std::min(
          result.release_s,
          values[static_cast<Eigen::Index>(problem.first_of_swing(i) + 2)] - swings[i].t_s.front());
    }
  }
  return result;
}

}  // namespace penduline
