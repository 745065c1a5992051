// SPDX-License-Identifier: Apache-2.0
// What each number of the fit says of each signal.
#include "host/calibration/swing_problem.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "host/fit/swing_path.hpp"

namespace penduline {
namespace {

constexpr double kFirstSignalSigmaV = 2e-3;

bool has_tilt_only(const SwingData& swing) {
  return swing.release && !swing.release->angles;
}

}  // namespace

SwingProblem::SwingProblem(const Pendulum<double>& pendulum, double length_share,
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

std::vector<double> SwingProblem::start_values() const {
  std::vector<double> values;
  for (const Unknown& unknown : unknowns_) {
    values.push_back(unknown.parameter.start);
  }
  return values;
}

std::array<std::size_t, kMaxSensors> SwingProblem::choose(double window_s,
                                                          const Eigen::VectorXd* values) {
  std::array<std::size_t, kMaxSensors> left_out{};
  places_.clear();
  for (std::size_t w = 0; w < swings_.size(); ++w) {
    const SwingData& swing = swings_[w];
    for (std::size_t i = 0; i < swing.t_s.size() && swing.t_s[i] <= swing.t_s[0] + window_s; ++i) {
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

void SwingProblem::residuals(const Eigen::VectorXd& values, Eigen::VectorXd& residuals) {
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

double SwingProblem::misfit_v(const Eigen::VectorXd& values, const Place& place) {
  return sensors_.volts(sensor_numbers(values), place.sensor, gap_m(values, place)) -
         swings_[place.swing].volts[place.sample][place.sensor];
}

double SwingProblem::gap_m(const Eigen::VectorXd& values, const Place& place) {
  return sensors_.gap_m(sensor_numbers(values), place.sensor,
                        path(values, place.swing)[place.sample]);
}

std::size_t SwingProblem::prior_count() const {
  return static_cast<std::size_t>(
      std::ranges::count_if(
          unknowns_, [](const Unknown& unknown) { return std::isfinite(unknown.prior_sigma); }) +
      std::ranges::count_if(swings_, has_tilt_only));
}

void SwingProblem::add_pendulum(const Pendulum<double>& pendulum, double length_share) {
  constexpr double kFriction = 0.05;
  unknowns_.push_back({{.name = "effective_length_m",
                        .start = pendulum.length_m,
                        .scale = 1e-3 * pendulum.length_m},
                       length_share * pendulum.length_m});
  const auto add = [&](const char* name, double start) {
    unknowns_.push_back({{.name = name, .start = start, .scale = 1e-3, .low = 0}, kFriction});
  };
  add("damping_per_s", pendulum.damping_per_s);
  add("quadratic_per_rad", 0);
  add("dry_rad_s2", 0);
}

void SwingProblem::add_start(const SwingData& swing, const Pendulum<double>& pendulum) {
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

const std::vector<DiscPlane<double>>& SwingProblem::path(const Eigen::VectorXd& values,
                                                         std::size_t swing) {
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

std::vector<DiscPlane<double>> SwingProblem::planes_of(const SwingData& swing,
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

}  // namespace penduline
