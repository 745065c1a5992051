// SPDX-License-Identifier: Apache-2.0
// An extended Kalman filter on the pendulum's own dynamics: its state, its algebra.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "common/dynamics.hpp"
#include "common/filter_trust.hpp"
#include "common/gap_gradient.hpp"
#include "common/gap_measurement.hpp"
#include "common/swing_step.hpp"

namespace penduline {

/// State theta1, theta2, omega1, omega2, ln(length / nominal length), damping, one offset a sensor
/// (method.md eq. 25).
template <class Scalar>
class SwingFilter {
 public:
  static constexpr std::size_t kMotion = 4;
  static constexpr std::size_t kLength = 4;
  static constexpr std::size_t kDamping = 5;
  static constexpr std::size_t kOffsets = 6;
  static constexpr std::size_t kMostStates = kOffsets + kMaxSensors;
  using State = std::array<Scalar, kMostStates>;
  /// Derivative of the motion after a step by motion, length and damping before it. What is not
  /// motion stays as it is.
  using Transition = std::array<std::array<Scalar, kOffsets>, kMotion>;

  SwingFilter(const SensorLayout<Scalar>& layout, const Pendulum<Scalar>& pendulum,
              const FilterTrust<Scalar>& trust)
      : layout_(layout), pendulum_(pendulum), trust_(trust), states_(kOffsets + layout.count) {}

  /// Begins at given angles, all else as it was told: rates 0 within `omega_sigma_rad_s`.
  void begin(const Angles<Scalar>& angles, Scalar theta_sigma_rad, Scalar omega_sigma_rad_s) {
    state_ = {angles.theta1_rad, angles.theta2_rad};
    state_[kDamping] = pendulum_.damping_per_s;
    tilt_ = tilt_of(state_);
    for (auto& row : covariance_) {
      row.fill(0);
    }
    for (std::size_t i = 0; i < 2; ++i) {
      covariance_[i][i] = theta_sigma_rad * theta_sigma_rad;
      covariance_[2 + i][2 + i] = omega_sigma_rad_s * omega_sigma_rad_s;
    }
    covariance_[kLength][kLength] = trust_.length_share * trust_.length_share;
    covariance_[kDamping][kDamping] = trust_.damping_per_s * trust_.damping_per_s;
    for (std::size_t i = kOffsets; i < states_; ++i) {
      covariance_[i][i] = trust_.offset_m * trust_.offset_m;
    }
  }

  /// Goes on in time by `seconds`; `acceleration` and `damping_walk` are the noises that move the
  /// pendulum and change its damping, as in FilterTrust (method.md eqs. 26 and 27). The length
  /// changes as exp of its state.
  Transition predict(Scalar seconds, Scalar acceleration, Scalar damping_walk) {
    const SwingVector<Scalar> motion(state_[0], state_[1], state_[2], state_[3]);
    const Scalar stiffness = stiffness_1_s2();
    const MotionStep<Scalar> step =
        swing_on(motion, {.stiffness_1_s2 = stiffness, .damping_per_s = state_[kDamping]}, seconds);
    for (std::size_t i = 0; i < kMotion; ++i) {
      state_[i] = step.motion[static_cast<Eigen::Index>(i)];
    }
    tilt_ = tilt_of(state_);
    const Transition transition = transition_of(step.jacobian, stiffness);
    transform(transition);
    const Scalar power = acceleration * acceleration * seconds;
    for (std::size_t i = 0; i < 2; ++i) {
      covariance_[i][i] += power * seconds * seconds / 3;
      covariance_[i][i + 2] += power * seconds / 2;
      covariance_[i + 2][i] = covariance_[i][i + 2];
      covariance_[i + 2][i + 2] += power;
    }
    covariance_[kDamping][kDamping] += damping_walk * damping_walk * seconds;
    for (std::size_t i = kOffsets; i < states_; ++i) {
      covariance_[i][i] += trust_.offset_walk_m_s05 * trust_.offset_walk_m_s05 * seconds;
    }
    return transition;
  }

  /// What a measurement is beside what was expected of it.
  struct Innovation {
    Scalar misfit_m = 0;
    Scalar variance_m2 = 0;
    /// 1 on average where all is as the filter believes.
    [[nodiscard]] Scalar normalized_square() const { return misfit_m * misfit_m / variance_m2; }
  };
  [[nodiscard]] Innovation innovation(const GapMeasurement<Scalar>& measured) const {
    const Expected expected = expect(measured.sensor);
    const State spread = spread_of(expected, measured.sensor);
    return {.misfit_m = measured.gap_m - expected.gap_m,
            .variance_m2 = along(expected, measured.sensor, spread) + measured.variance_m2};
  }

  /// Takes a measurement; linearized anew, three times at the most, where the curvature on the way
  /// is a tenth of the noise. With `motion_only` what is learned of the pendulum stays as it is.
  void update(const GapMeasurement<Scalar>& measured, bool motion_only) {
    constexpr int kMostRounds = 3;
    const State before = state_;
    const std::size_t learned_from = motion_only ? kMotion : states_;
    Expected expected = expect(measured.sensor);
    for (int round = 1;; ++round) {
      const State spread = spread_of(expected, measured.sensor);
      const Scalar variance = along(expected, measured.sensor, spread) + measured.variance_m2;
      const Scalar misfit =
          measured.gap_m - expected.gap_m - change(expected, measured.sensor, state_, before);
      State gain{};
      for (std::size_t i = 0; i < learned_from; ++i) {
        gain[i] = spread[i] / variance;
      }
      const State last = state_;
      for (std::size_t i = 0; i < states_; ++i) {
        state_[i] = before[i] + gain[i] * misfit;
      }
      tilt_ = tilt_of(state_);
      const Expected next = expect(measured.sensor);
      const Scalar bend =
          next.gap_m - expected.gap_m - change(expected, measured.sensor, last, state_);
      if (round == kMostRounds || 100 * bend * bend < measured.variance_m2) {
        narrow(expected, measured, spread, gain);
        return;
      }
      expected = next;
    }
  }

  /// Says that the pendulum was moved from outside: what is known of its motion is less now.
  void loosen(Scalar theta_sigma_rad, Scalar omega_sigma_rad_s) {
    for (std::size_t i = 0; i < 2; ++i) {
      covariance_[i][i] += theta_sigma_rad * theta_sigma_rad;
      covariance_[2 + i][2 + i] += omega_sigma_rad_s * omega_sigma_rad_s;
    }
  }

  [[nodiscard]] const State& state() const { return state_; }
  [[nodiscard]] Scalar variance(std::size_t i) const { return covariance_[i][i]; }
  [[nodiscard]] Scalar covariance(std::size_t i, std::size_t j) const { return covariance_[i][j]; }
  [[nodiscard]] std::size_t states() const { return states_; }
  /// Whether state and variances are those of a pendulum that hangs: measurements that contradict
  /// the rig by far may take them anywhere, and to what is no number.
  [[nodiscard]] bool is_sound() const {
    constexpr Scalar kMostThetaRad = Scalar(1.5);
    constexpr Scalar kMostOmegaRadPerS = 200;
    constexpr Scalar kMostLogLength = 1;
    bool sound = std::abs(state_[kLength]) < kMostLogLength;
    for (std::size_t i = 0; i < 2; ++i) {
      sound = sound && std::abs(state_[i]) < kMostThetaRad &&
              std::abs(state_[2 + i]) < kMostOmegaRadPerS;
    }
    for (std::size_t i = 0; i < states_; ++i) {
      sound = sound && std::isfinite(state_[i]) && covariance_[i][i] >= 0 &&
              std::isfinite(covariance_[i][i]);
    }
    return sound;
  }
  [[nodiscard]] Scalar length_m() const { return pendulum_.length_m * std::exp(state_[kLength]); }

 private:
  using Expected = GapGradient<Scalar>;

  [[nodiscard]] Scalar stiffness_1_s2() const { return pendulum_.gravity_m_s2 / length_m(); }

  [[nodiscard]] static Tilt<Scalar> tilt_of(const State& state) {
    return tilt_at(Angles<Scalar>{.theta1_rad = state[0], .theta2_rad = state[1]});
  }

  /// The gap that the state makes one expect; its derivative by the sensor's own offset is 1.
  [[nodiscard]] Expected expect(std::size_t sensor) const {
    Expected expected = gap_gradient(layout_, sensor, tilt_);
    expected.gap_m += state_[kOffsets + sensor];
    return expected;
  }

  /// What an expected gap changes by from one state to another, to first order.
  [[nodiscard]] static Scalar change(const Expected& expected, std::size_t sensor,
                                     const State& from, const State& to) {
    return expected.by_theta1_m * (to[0] - from[0]) + expected.by_theta2_m * (to[1] - from[1]) +
           (to[kOffsets + sensor] - from[kOffsets + sensor]);
  }

  /// The derivative of an expected gap, times a vector.
  [[nodiscard]] static Scalar along(const Expected& expected, std::size_t sensor,
                                    const State& vector) {
    return expected.by_theta1_m * vector[0] + expected.by_theta2_m * vector[1] +
           vector[kOffsets + sensor];
  }

  /// The covariance times the derivative of an expected gap.
  [[nodiscard]] State spread_of(const Expected& expected, std::size_t sensor) const {
    State spread{};
    for (std::size_t i = 0; i < states_; ++i) {
      spread[i] = along(expected, sensor, covariance_[i]);
    }
    return spread;
  }

  [[nodiscard]] static Transition transition_of(const MotionJacobian<Scalar>& jacobian,
                                                Scalar stiffness) {
    Transition by{};
    for (std::size_t i = 0; i < kMotion; ++i) {
      for (std::size_t j = 0; j < kOffsets; ++j) {
        by[i][j] = jacobian(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
      }
      by[i][kLength] *= -stiffness;  // d(g/l) / d(ln l)
    }
    return by;
  }

  /// F P F' (method.md eq. 26), F the identity but for the motion's rows.
  void transform(const Transition& by) {
    std::array<State, kMotion> half{};
    for (std::size_t i = 0; i < kMotion; ++i) {
      for (std::size_t j = 0; j < states_; ++j) {
        for (std::size_t k = 0; k < kOffsets; ++k) {
          half[i][j] += by[i][k] * covariance_[k][j];
        }
      }
    }
    for (std::size_t i = 0; i < kMotion; ++i) {
      for (std::size_t j = kMotion; j < states_; ++j) {
        covariance_[i][j] = covariance_[j][i] = half[i][j];
      }
      for (std::size_t j = 0; j <= i; ++j) {
        Scalar sum = 0;
        for (std::size_t k = 0; k < kOffsets; ++k) {
          sum += half[i][k] * by[j][k];
        }
        covariance_[i][j] = covariance_[j][i] = sum;
      }
    }
  }

  /// Covariance after a measurement in Joseph's form, right for any gain and never negative
  /// (method.md eq. 30).
  void narrow(const Expected& expected, const GapMeasurement<Scalar>& measured, const State& spread,
              const State& gain) {
    for (std::size_t i = 0; i < states_; ++i) {
      for (std::size_t j = 0; j < states_; ++j) {
        covariance_[i][j] -= gain[i] * spread[j];
      }
    }
    const State rest = spread_of(expected, measured.sensor);
    for (std::size_t i = 0; i < states_; ++i) {
      for (std::size_t j = 0; j <= i; ++j) {
        const Scalar value =
            covariance_[i][j] + (gain[i] * measured.variance_m2 - rest[i]) * gain[j];
        covariance_[i][j] = covariance_[j][i] = value;
      }
    }
  }

  SensorLayout<Scalar> layout_;
  Pendulum<Scalar> pendulum_;
  FilterTrust<Scalar> trust_;
  std::size_t states_;
  State state_{};
  Tilt<Scalar> tilt_;  ///< at `state_`
  std::array<State, kMostStates> covariance_{};
};

}  // namespace penduline
