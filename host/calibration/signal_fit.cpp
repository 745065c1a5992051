// SPDX-License-Identifier: Apache-2.0
// The pendulum's own path as the yardstick of its sensors.
#include "host/calibration/signal_fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "host/fit/swing_path.hpp"

namespace penduline {
namespace {

constexpr double kFirstSignalSigmaV = 2e-3;

/// Where one signal of the fit stands.
struct Place {
  std::size_t swing;
  std::size_t sample;
  std::size_t sensor;
};

/// The fit's numbers and what they say of each signal.
class SwingProblem {
 public:
  SwingProblem(const Pendulum<double>& pendulum, double length_share,
               const std::vector<SwingData>& swings, const SensorModel& sensors)
      : gravity_m_s2_(pendulum.gravity_m_s2), swings_(swings), sensors_(sensors) {
    sigma_v_.fill(kFirstSignalSigmaV);
    add_pendulum(pendulum, length_share);
    for (const SwingData& swing : swings) {
      first_of_swing_.push_back(unknowns_.size());
      add_start(swing, pendulum);
    }
    first_sensor_number_ = unknowns_.size();
    const std::vector<Unknown> seen = sensors.unknowns();
    unknowns_.insert(unknowns_.end(), seen.begin(), seen.end());
    paths_.resize(swings.size());
  }

  [[nodiscard]] const std::vector<Unknown>& unknowns() const { return unknowns_; }
  [[nodiscard]] std::size_t first_sensor_number() const { return first_sensor_number_; }
  [[nodiscard]] std::size_t first_of_swing(std::size_t swing) const {
    return first_of_swing_[swing];
  }
  [[nodiscard]] const std::vector<Place>& places() const { return places_; }
  [[nodiscard]] std::size_t residual_count() const { return places_.size() + prior_count(); }
  void set_sigma_v(std::size_t sensor, double sigma_v) { sigma_v_[sensor] = sigma_v; }

  [[nodiscard]] std::vector<double> start_values() const {
    std::vector<double> values;
    for (const Unknown& unknown : unknowns_) {
      values.push_back(unknown.parameter.start);
    }
    return values;
  }

  /// Chooses the signals of the first `window_s` of each swing: by the numbers' own gaps or, where
  /// there are none yet, by what was doubtful beforehand. Returns how many of each sensor are left
  /// out.
  std::array<std::size_t, kMaxSensors> choose(double window_s, const Eigen::VectorXd* values) {
    std::array<std::size_t, kMaxSensors> left_out{};
    places_.clear();
    for (std::size_t w = 0; w < swings_.size(); ++w) {
      const SwingData& swing = swings_[w];
      for (std::size_t i = 0; i < swing.t_s.size() && swing.t_s[i] <= swing.t_s[0] + window_s;
           ++i) {
        for (std::size_t s = 0; s < sensors_.sensor_count(); ++s) {
          const bool good = std::isfinite(swing.volts[i][s]) &&
                            (values == nullptr ? !swing.doubtful[i][s]
                                               : sensors_.readable(sensor_numbers(*values), s,
                                                                   gap_m(*values, {w, i, s})));
          left_out[s] += good ? 0 : 1;
          if (good) {
            places_.push_back({w, i, s});
          }
        }
      }
    }
    return left_out;
  }

  void residuals(const Eigen::VectorXd& values, Eigen::VectorXd& residuals) {
    Eigen::Index at = 0;
    for (const Place& place : places_) {
      residuals[at++] = misfit_v(values, place) / sigma_v_[place.sensor];
    }
    for (std::size_t i = 0; i < unknowns_.size(); ++i) {
      const Unknown& unknown = unknowns_[i];
      if (std::isfinite(unknown.prior_sigma)) {
        residuals[at++] =
            (values[static_cast<Eigen::Index>(i)] - unknown.parameter.start) / unknown.prior_sigma;
      }
    }
    for (std::size_t w = 0; w < swings_.size(); ++w) {
      if (has_tilt_only(swings_[w])) {
        const double* start = values.data() + first_of_swing_[w];
        const double tilt_rad = std::acos(std::cos(start[0]) * std::cos(start[1]));
        residuals[at++] = (tilt_rad - swings_[w].release->tilt_rad) / Release::kSigmaRad;
      }
    }
  }

  [[nodiscard]] double misfit_v(const Eigen::VectorXd& values, const Place& place) {
    return sensors_.volts(sensor_numbers(values), place.sensor, gap_m(values, place)) -
           swings_[place.swing].volts[place.sample][place.sensor];
  }

  [[nodiscard]] double gap_m(const Eigen::VectorXd& values, const Place& place) {
    return sensors_.gap_m(sensor_numbers(values), place.sensor,
                          path(values, place.swing)[place.sample]);
  }

  [[nodiscard]] std::span<const double> sensor_numbers(const Eigen::VectorXd& values) const {
    return {values.data() + first_sensor_number_, unknowns_.size() - first_sensor_number_};
  }

 private:
  /// The disc along one swing, for the numbers that it was made from.
  struct Path {
    std::vector<double> key;
    std::vector<DiscPlane<double>> planes;
  };

  static bool has_tilt_only(const SwingData& swing) {
    return swing.release && !swing.release->angles;
  }

  [[nodiscard]] std::size_t prior_count() const {
    return static_cast<std::size_t>(
        std::ranges::count_if(
            unknowns_, [](const Unknown& unknown) { return std::isfinite(unknown.prior_sigma); }) +
        std::ranges::count_if(swings_, has_tilt_only));
  }

  void add_pendulum(const Pendulum<double>& pendulum, double length_share) {
    constexpr double kFriction = 0.05;
    const auto add = [&](const char* name, double start, double scale, double prior) {
      unknowns_.push_back({{.name = name, .start = start, .scale = scale}, prior});
    };
    add("effective_length_m", pendulum.length_m, 1e-3 * pendulum.length_m,
        length_share * pendulum.length_m);
    add("damping_per_s", pendulum.damping_per_s, 1e-3, kFriction);
    add("quadratic_per_rad", 0, 1e-3, kFriction);
    add("dry_rad_s2", 0, 1e-3, kFriction);
  }

  void add_start(const SwingData& swing, const Pendulum<double>& pendulum) {
    constexpr double kAngle = 1e-3;
    const double omega = std::sqrt(pendulum.gravity_m_s2 / pendulum.length_m);
    const auto add = [&](const char* name, double start, double scale, double prior) {
      unknowns_.push_back({{.name = fmt::format("swing {} {}", first_of_swing_.size(), name),
                            .start = start,
                            .scale = scale},
                           prior});
    };
    constexpr double kNone = std::numeric_limits<double>::infinity();
    if (swing.release) {
      const double prior = swing.release->angles ? Release::kSigmaRad : kNone;
      const Angles<double> angles = swing.release->angles.value_or(
          Angles<double>{swing.start.theta1_rad, swing.start.theta2_rad});
      add("theta1_rad", angles.theta1_rad, kAngle, prior);
      add("theta2_rad", angles.theta2_rad, kAngle, prior);
      add("released_s", swing.released_s, kAngle / omega * 10, kNone);
      return;
    }
    add("theta1_rad", swing.start.theta1_rad, kAngle, kNone);
    add("theta2_rad", swing.start.theta2_rad, kAngle, kNone);
    add("omega1_rad_s", swing.start.omega1_rad_s, kAngle * omega, kNone);
    add("omega2_rad_s", swing.start.omega2_rad_s, kAngle * omega, kNone);
  }

  const std::vector<DiscPlane<double>>& path(const Eigen::VectorXd& values, std::size_t swing) {
    const std::size_t first = first_of_swing_[swing];
    const std::size_t end =
        swing + 1 < swings_.size() ? first_of_swing_[swing + 1] : first_sensor_number_;
    std::vector<double> key(values.data(), values.data() + kPendulumNumbers);
    key.insert(key.end(), values.data() + first, values.data() + end);
    Path& known = paths_[swing];
    if (key != known.key) {
      known.planes = planes_of(swings_[swing], key);
      known.key = std::move(key);
    }
    return known.planes;
  }

  [[nodiscard]] std::vector<DiscPlane<double>> planes_of(const SwingData& swing,
                                                         const std::vector<double>& key) const {
    const FreeSwing free{
        .stiffness_1_s2 = gravity_m_s2_ / key[0],
        .friction = {.linear_per_s = key[1], .quadratic_per_rad = key[2], .dry_rad_s2 = key[3]}};
    const double* start = key.data() + kPendulumNumbers;
    SwingState<double> state{.theta1_rad = start[0], .theta2_rad = start[1]};
    double start_s = swing.t_s.front();
    if (swing.release) {
      start_s = start[2];
    } else {
      state.omega1_rad_s = start[2];
      state.omega2_rad_s = start[3];
    }
    std::vector<DiscPlane<double>> planes;
    planes.reserve(swing.t_s.size());
    const auto put = [&](const SwingState<double>& at) {
      planes.emplace_back(slopes_of(Angles<double>{at.theta1_rad, at.theta2_rad}));
    };
    std::vector<double> times{start_s};
    for (const double t_s : swing.t_s) {
      if (t_s > start_s) {
        times.push_back(t_s);
      } else {
        put(state);  // held still until it is let go
      }
    }
    const std::vector<SwingState<double>> path = swing_path(free, state, times);
    std::for_each(path.begin() + 1, path.end(), put);
    return planes;
  }

  double gravity_m_s2_;
  const std::vector<SwingData>& swings_;
  const SensorModel& sensors_;
  std::vector<Unknown> unknowns_;
  std::vector<std::size_t> first_of_swing_;
  std::size_t first_sensor_number_ = 0;
  std::array<double, kMaxSensors> sigma_v_{};
  std::vector<Place> places_;
  std::vector<Path> paths_;
};

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
