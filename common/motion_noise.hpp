// SPDX-License-Identifier: Apache-2.0
// How far the motion may leave what the model of it says.
#pragma once

#include <algorithm>

namespace penduline {

/// The acceleration noise of the Kalman filter, in rad/s^2 in the square root of a Hz. It grows
/// while innovations are larger than believed and shrinks to what it was told when they are not:
/// friction that is not linear, a draught, a pivot that gives (method.md eq. 31). A hand makes it
/// jump.
template <class Scalar>
class MotionNoise {
 public:
  /// `least_rad_s15` is that of the rig (FilterTrust), above 0.
  explicit MotionNoise(Scalar least_rad_s15) : least_(least_rad_s15), now_(least_rad_s15) {}

  /// Learns from a normalized square of an innovation (1 on average where all is as believed) that
  /// stands for so much time.
  void learn(Scalar normalized_square, Scalar seconds) {
    const Scalar excess = std::min(normalized_square, kMostSquare) - kUsualSquare;
    now_ *= 1 + std::clamp(kSpeed * seconds * excess, Scalar(-0.5), Scalar(0.5));
    now_ = std::clamp(now_, least_, std::max(least_, kHand));
  }

  /// From now on the motion may be anything that a hand does.
  void jump() { now_ = std::max(least_, kHand); }
  void reset() { now_ = least_; }

  [[nodiscard]] Scalar rad_s15() const { return now_; }
  /// Whether the motion says next to nothing of the pendulum itself.
  [[nodiscard]] bool disturbed() const { return now_ > std::max(least_, kDisturbed); }
  /// The walk of the damping grows as well, but little: near rest nothing holds it back.
  [[nodiscard]] Scalar damping_factor() const { return std::min(now_ / least_, kMostDamping); }

 private:
  static constexpr Scalar kSpeed = 4;  ///< e-fold per second and unit of excess
  static constexpr Scalar kUsualSquare = Scalar(1.5);
  static constexpr Scalar kMostSquare = 9;
  static constexpr Scalar kHand = 3;
  static constexpr Scalar kDisturbed = Scalar(0.3);
  static constexpr Scalar kMostDamping = 4;

  Scalar least_;
  Scalar now_;
};

}  // namespace penduline
