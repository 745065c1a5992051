// SPDX-License-Identifier: Apache-2.0
// Tells a stray reading from a pendulum that something else moves.
#pragma once

#include <algorithm>
#include <cstdint>

namespace penduline {

/// Follows the normalized squares of innovations, which are 1 on average while the pendulum swings
/// as the filter believes.
template <class Scalar>
class InnovationWatch {
 public:
  /// A reading five standard deviations off is left out, unless too many are.
  static constexpr Scalar kStraySquare = 25;

  enum class Verdict {
    kUsual,
    kStray,      ///< to be left out
    kDisturbed,  ///< the motion is not the filter's any more
  };

  Verdict judge(Scalar normalized_square) {
    const Scalar weight = normalized_square < kGoodSquare ? kWeightOfGood : kWeight;
    mean_ += (std::min(normalized_square, kStraySquare) - mean_) * weight;
    if (mean_ > kDisturbedMean) {
      mean_ = 1;
      return Verdict::kDisturbed;
    }
    return normalized_square > kStraySquare ? Verdict::kStray : Verdict::kUsual;
  }

  void reset() { mean_ = 1; }

 private:
  /// Of the newest in the mean: two stray readings do not make a disturbance, a third in a row
  /// does.
  static constexpr Scalar kWeight = Scalar(1) / 16;
  /// Where something else moves the pendulum few readings are good by chance.
  static constexpr Scalar kGoodSquare = 4;
  static constexpr Scalar kWeightOfGood = Scalar(1) / 4;
  /// Twelve standard deviations of the mean.
  static constexpr Scalar kDisturbedMean = 4;

  Scalar mean_ = 1;
};

}  // namespace penduline
