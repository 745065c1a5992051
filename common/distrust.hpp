// SPDX-License-Identifier: Apache-2.0
// How much less the model of the motion is worth than it was said to be.
#pragma once

#include <algorithm>

namespace penduline {

/// Multiplies the acceleration noise while innovations are larger than believed, and takes it back
/// when they are not: friction that is not linear, a draught, a pivot that gives.
template <class Scalar>
class Distrust {
 public:
  /// Learns from a normalized square (1 on average where all is as believed) that stands for so
  /// much time.
  void learn(Scalar normalized_square, Scalar seconds) {
    const Scalar excess = std::min(normalized_square, kMostSquare) - kUsualSquare;
    const Scalar change = std::clamp(kSpeed * seconds * excess, Scalar(-0.5), Scalar(0.5));
    factor_ = std::clamp(factor_ * (1 + change), Scalar(1), kMostFactor);
  }

  [[nodiscard]] Scalar factor() const { return factor_; }

 private:
  static constexpr Scalar kSpeed = 2;  ///< e-fold per second and unit of excess
  static constexpr Scalar kUsualSquare = Scalar(1.1);
  static constexpr Scalar kMostSquare = 9;
  static constexpr Scalar kMostFactor = 100;

  Scalar factor_ = 1;
};

}  // namespace penduline
