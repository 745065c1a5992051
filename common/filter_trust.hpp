// SPDX-License-Identifier: Apache-2.0
// How far the Kalman filter trusts what it is told: sensors, pendulum, and that nothing else moves
// it.
#pragma once

namespace penduline {

/// What a sensor's reading is off by, of one sample, 1 sigma: in the signal, and in the gap itself.
template <class Scalar>
struct SensorNoise {
  Scalar volts = Scalar(0.0005);
  Scalar gap_m = Scalar(10e-6);
};

/// How much the filter believes of what it was told; 1-sigma throughout.
template <class Scalar>
struct FilterTrust {
  Scalar length_share = Scalar(0.02);           ///< of the length, at the start
  Scalar damping_per_s = Scalar(0.3);           ///< of the damping, at the start
  Scalar offset_m = 0;                          ///< of each sensor's gap, at the start
  Scalar acceleration_rad_s15 = Scalar(0.002);  ///< white: rad/s^2 in the square root of a Hz
  Scalar damping_walk_per_s15 = Scalar(0.005);  ///< what the damping changes in root a second
  Scalar offset_walk_m_s05 = 0;                 ///< the same of each offset
};

}  // namespace penduline
