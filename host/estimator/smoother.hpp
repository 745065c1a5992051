// SPDX-License-Identifier: Apache-2.0
// The estimator `smoother`: the Kalman filter forwards, then corrected by what came later.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <deque>

#include "common/gap_measurement.hpp"
#include "common/swing_tracker.hpp"
#include "host/estimator/estimator.hpp"

namespace penduline {

/// Rauch, Tung and Striebel's smoother on the steps of `SwingTracker` (method.md eq. 32). Each
/// estimate has seen the samples of 20 s after it, where there are so many; memory is kept for
/// twice that time, 2.2 kB a sample of two sensors, however long the recording is, and for 40 000
/// samples at most: above 1 kHz an estimate has seen the next 20 000 samples instead.
class Smoother final : public Estimator {
 public:
  static constexpr std::int64_t kAheadUs = 20'000'000;
  static constexpr std::size_t kMostSteps = 40'000;

  Smoother(const Rig<double>& rig, const Acquisition<double>& acquisition);

  tl::expected<void, Error> take(const Sample& sample, EstimateSink& sink) override;
  tl::expected<void, Error> finish(EstimateSink& sink) override;

 private:
  /// A state of `SwingFilter` with its covariance.
  struct Belief {
    Eigen::VectorXd state;
    Eigen::MatrixXd covariance;
  };
  /// One sample, as the filter went through it.
  struct Step {
    Estimate<double> estimate;
    GapMeasurements<double> measured;
    Eigen::MatrixXd transition;  ///< from the step before; empty: nothing leads here
    Belief predicted;            ///< before this sample's gaps
    Belief filtered;             ///< after them
  };
  class Witness;

  [[nodiscard]] static Belief belief_of(const SwingFilter<double>& filter);
  [[nodiscard]] static bool is_sound(const Belief& belief);
  /// What is believed of a step once the next one, `later`, is known to be as `smoothed`.
  [[nodiscard]] static Belief smoothed_before(const Step& step, const Step& later,
                                              const Belief& smoothed);
  /// Goes back from the newest step; hands on the first `count` and forgets them.
  tl::expected<void, Error> hand_on(std::size_t count, EstimateSink& sink);

  Rig<double> rig_;
  SwingTracker<double> tracker_;
  std::deque<Step> steps_;  ///< each but the first follows from the one before it
};

}  // namespace penduline
