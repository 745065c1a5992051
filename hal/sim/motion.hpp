// SPDX-License-Identifier: Apache-2.0
// The true motion of a simulated pendulum: the paper's two Euler schemes and an exact integrator.
#pragma once

#include <memory>

#include "common/dynamics.hpp"

namespace penduline {

/// How the motion is integrated.
enum class Integrator {
  kEuler,         ///< the paper's Eqs. 16 to 19 in (theta, phi), as printed
  kSemiImplicit,  ///< the same with the updated velocities
  kDopri5,        ///< Dormand-Prince 5(4) in (theta1, theta2), to 1e-12
  kHeld,          ///< none: a jig holds the pendulum where it starts
};

/// Where the swing starts, in the paper's coordinates: theta the tilt from the vertical, phi the
/// azimuth from X, omega and psi their rates.
struct SwingStart {
  double theta_rad = 0;
  double phi_rad = 0;
  double omega_rad_s = 0;
  double psi_rad_s = 0;
};

/// The same start in the sensor's angles (method.md eq. 3).
[[nodiscard]] SwingState<double> swing_state(const SwingStart& start);

/// A pendulum's motion from t = 0 on.
class Motion {
 public:
  Motion() = default;
  Motion(const Motion&) = delete;
  Motion& operator=(const Motion&) = delete;
  virtual ~Motion() = default;

  /// Goes on to a time not before the one reached.
  virtual void advance_to(double t_s) = 0;
  /// The state at the time reached. Not finite once an Euler scheme has run away, or the exact
  /// integrator has come to the X axis, where theta1 has no value.
  [[nodiscard]] virtual SwingState<double> state() const = 0;
};

/// A motion; the Euler schemes step every `step_s`.
[[nodiscard]] std::unique_ptr<Motion> make_motion(Integrator integrator, const SwingStart& start,
                                                  const Pendulum<double>& pendulum, double step_s);

}  // namespace penduline
