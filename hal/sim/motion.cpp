// SPDX-License-Identifier: Apache-2.0
// The integrators behind a simulated pendulum.
#include "hal/sim/motion.hpp"

#include <algorithm>
#include <array>
#include <boost/numeric/odeint.hpp>
#include <cmath>
#include <cstdint>
#include <limits>

namespace penduline {
namespace {

/// The paper's equations, stepped as it prints them: Eqs. 12 to 15 by Eqs. 16 to 19.
class PaperMotion final : public Motion {
 public:
  PaperMotion(const SwingStart& start, const Pendulum<double>& pendulum, double step_s,
              bool updated_velocity)
      : now_(start), pendulum_(pendulum), step_s_(step_s), updated_velocity_(updated_velocity) {}

  void advance_to(double t_s) override {
    const auto target = std::llround(t_s / step_s_);
    for (; steps_ < target; ++steps_) {
      step();
    }
  }

  [[nodiscard]] SwingState<double> state() const override { return swing_state(now_); }

 private:
  void step() {
    const SwingStart before = now_;
    const double sine = std::sin(before.theta_rad);
    const double cosine = std::cos(before.theta_rad);
    const double stiffness = pendulum_.gravity_m_s2 / pendulum_.length_m;
    now_.omega_rad_s += step_s_ * (before.psi_rad_s * before.psi_rad_s * sine * cosine -
                                   stiffness * sine - pendulum_.damping_per_s * before.omega_rad_s);
    now_.psi_rad_s +=
        step_s_ * (-2 * before.omega_rad_s * before.psi_rad_s / std::tan(before.theta_rad) -
                   pendulum_.damping_per_s * before.psi_rad_s);
    const SwingStart& velocity = updated_velocity_ ? now_ : before;
    now_.theta_rad = before.theta_rad + step_s_ * velocity.omega_rad_s;
    now_.phi_rad = before.phi_rad + step_s_ * velocity.psi_rad_s;
  }

  SwingStart now_;
  Pendulum<double> pendulum_;
  double step_s_;
  bool updated_velocity_;
  std::int64_t steps_ = 0;
};

/// The motion in the sensor's own angles, exact for our purposes.
class ExactMotion final : public Motion {
 public:
  ExactMotion(const SwingStart& start, const Pendulum<double>& pendulum) : pendulum_(pendulum) {
    const SwingState<double> state = swing_state(start);
    vector_ = {state.theta1_rad, state.theta2_rad, state.omega1_rad_s, state.omega2_rad_s};
  }

  void advance_to(double t_s) override {
    using boost::numeric::odeint::integrate_adaptive;
    using boost::numeric::odeint::make_controlled;
    using boost::numeric::odeint::runge_kutta_dopri5;
    constexpr double kTolerance = 1e-12;
    constexpr double kFirstStep = 1e-3;
    if (t_s <= t_s_) {
      return;
    }
    integrate_adaptive(
        make_controlled<runge_kutta_dopri5<Vector>>(kTolerance, kTolerance),
        [this](const Vector& state, Vector& change, double) {
          const SwingState<double> now = unpacked(state);
          near_pole_ = near_pole_ || std::abs(std::cos(now.theta2_rad)) < kNearPole;
          const SwingState<double> rate =
              near_pole_ ? SwingState<double>{} : swing_derivative(now, pendulum_);
          change = {rate.theta1_rad, rate.theta2_rad, rate.omega1_rad_s, rate.omega2_rad_s};
        },
        vector_, t_s_, t_s, std::min(kFirstStep, t_s - t_s_));
    t_s_ = t_s;
  }

  [[nodiscard]] SwingState<double> state() const override {
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    return near_pole_ ? SwingState<double>{kNone, kNone, kNone, kNone} : unpacked(vector_);
  }

 private:
  using Vector = std::array<double, 4>;

  static SwingState<double> unpacked(const Vector& vector) {
    return {.theta1_rad = vector[0],
            .theta2_rad = vector[1],
            .omega1_rad_s = vector[2],
            .omega2_rad_s = vector[3]};
  }

  /// Where the rod lies along X, theta1 has no value, and what comes after it is wrong.
  static constexpr double kNearPole = 0.02;

  Pendulum<double> pendulum_;
  Vector vector_{};
  double t_s_ = 0;
  bool near_pole_ = false;
};

/// A pendulum that is held.
class HeldMotion final : public Motion {
 public:
  explicit HeldMotion(const SwingStart& start)
      : state_(swing_state({.theta_rad = start.theta_rad, .phi_rad = start.phi_rad})) {}

  void advance_to(double /*t_s*/) override {}
  [[nodiscard]] SwingState<double> state() const override { return state_; }

 private:
  SwingState<double> state_;
};

}  // namespace

SwingState<double> swing_state(const SwingStart& start) {
  const double sin_theta = std::sin(start.theta_rad);
  const double cos_theta = std::cos(start.theta_rad);
  const double sin_phi = std::sin(start.phi_rad);
  const double cos_phi = std::cos(start.phi_rad);
  // The rod's direction and its change per second.
  const Vector3<double> rod(sin_theta * cos_phi, sin_theta * sin_phi, -cos_theta);
  const Vector3<double> change(
      cos_theta * cos_phi * start.omega_rad_s - sin_theta * sin_phi * start.psi_rad_s,
      cos_theta * sin_phi * start.omega_rad_s + sin_theta * cos_phi * start.psi_rad_s,
      sin_theta * start.omega_rad_s);
  const double across_x_squared = rod.y() * rod.y() + rod.z() * rod.z();
  return {.theta1_rad = std::atan2(rod.y(), -rod.z()),
          .theta2_rad = std::atan2(-rod.x(), std::sqrt(across_x_squared)),
          .omega1_rad_s = (rod.y() * change.z() - rod.z() * change.y()) / across_x_squared,
          .omega2_rad_s = -change.x() / std::sqrt(across_x_squared)};
}

std::unique_ptr<Motion> make_motion(Integrator integrator, const SwingStart& start,
                                    const Pendulum<double>& pendulum, double step_s) {
  if (integrator == Integrator::kDopri5) {
    return std::make_unique<ExactMotion>(start, pendulum);
  }
  if (integrator == Integrator::kHeld) {
    return std::make_unique<HeldMotion>(start);
  }
  return std::make_unique<PaperMotion>(start, pendulum, step_s,
                                       integrator == Integrator::kSemiImplicit);
}

}  // namespace penduline
