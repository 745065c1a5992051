// SPDX-License-Identifier: Apache-2.0
// A free swing and its sensors as a problem of least squares: numbers in, misfits out.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "host/calibration/signal_fit.hpp"

namespace penduline {

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
               const std::vector<SwingData>& swings, const SensorModel& sensors);

  [[nodiscard]] const std::vector<Unknown>& unknowns() const { return unknowns_; }
  [[nodiscard]] std::size_t first_sensor_number() const { return first_sensor_number_; }
  [[nodiscard]] std::size_t first_of_swing(std::size_t swing) const {
    return first_of_swing_[swing];
  }
  [[nodiscard]] const std::vector<Place>& places() const { return places_; }
  [[nodiscard]] std::size_t residual_count() const { return places_.size() + prior_count(); }
  void set_sigma_v(std::size_t sensor, double sigma_v) { sigma_v_[sensor] = sigma_v; }

  [[nodiscard]] std::vector<double> start_values() const;

  /// Chooses the signals of the first `window_s` of each swing: by the numbers' own gaps or, where
  /// there are none yet, by what was doubtful beforehand. Returns how many of each sensor are left
  /// out.
  std::array<std::size_t, kMaxSensors> choose(double window_s, const Eigen::VectorXd* values);

  /// Of the chosen signals, in their sigmas, then of what was known beforehand.
  void residuals(const Eigen::VectorXd& values, Eigen::VectorXd& residuals);
  /// The signal that the numbers say, less the one that there is.
  [[nodiscard]] double misfit_v(const Eigen::VectorXd& values, const Place& place);
  [[nodiscard]] double gap_m(const Eigen::VectorXd& values, const Place& place);

  [[nodiscard]] std::span<const double> sensor_numbers(const Eigen::VectorXd& values) const {
    return {values.data() + first_sensor_number_, unknowns_.size() - first_sensor_number_};
  }

 private:
  /// The disc along one swing, for the numbers that it was made from.
  struct Path {
    std::vector<double> key;
    std::vector<DiscPlane<double>> planes;
  };

  [[nodiscard]] std::size_t prior_count() const;
  void add_pendulum(const Pendulum<double>& pendulum, double length_share);
  void add_start(const SwingData& swing, const Pendulum<double>& pendulum);
  const std::vector<DiscPlane<double>>& path(const Eigen::VectorXd& values, std::size_t swing);
  [[nodiscard]] std::vector<DiscPlane<double>> planes_of(const SwingData& swing,
                                                         const std::vector<double>& key) const;

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

}  // namespace penduline
