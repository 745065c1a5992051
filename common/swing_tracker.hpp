// SPDX-License-Identifier: Apache-2.0
// The estimator `ekf`: from samples to angles, rates and their uncertainties, without delay.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "common/continuity.hpp"
#include "common/distrust.hpp"
#include "common/estimate.hpp"
#include "common/flags.hpp"
#include "common/gauss_newton.hpp"
#include "common/innovation_watch.hpp"
#include "common/rig.hpp"
#include "common/sample.hpp"
#include "common/swing_filter.hpp"

namespace penduline {

/// Turns samples into estimates, one for one, without heap, clock or I/O, as Pipeline does. Each is
/// of its own sample's moment.
template <class Scalar>
class SwingTracker {
 public:
  /// The rig's sensors must determine the tilt and be as many as the acquisition's.
  SwingTracker(const Rig<Scalar>& rig, const Acquisition<Scalar>& acquisition)
      : rig_(rig),
        acquisition_(acquisition),
        inverse_(rig.layout),
        filter_(rig.layout, rig.pendulum, rig.trust),
        continuity_(acquisition.longest_step_us()) {}

  Estimate<Scalar> update(const Sample& sample) {
    const Continuity::Verdict verdict = continuity_.follow(sample);
    Estimate<Scalar> estimate{
        .t_us = sample.t_us, .seq = sample.seq, .flags = sample.flags | verdict.flags};
    const Measurements measured = measure(sample, estimate.flags);
    const bool other_time = (estimate.flags & (flag::kRestarted | flag::kOutOfOrder)) != 0 ||
                            sample.t_us - last_t_us_ > kLongestBridge_us;
    if (!begun_ || other_time) {
      begun_ = begin(measured);
    } else {
      follow(measured, sample.t_us, estimate.flags);
    }
    last_t_us_ = sample.t_us;
    if (begun_) {
      fill(measured, estimate);
    } else {
      estimate.flags |= flag::kNoSolution;
    }
    return estimate;
  }

  [[nodiscard]] const SwingFilter<Scalar>& filter() const { return filter_; }

 private:
  struct Measurements {
    std::array<GapMeasurement<Scalar>, kMaxSensors> gap{};
    std::size_t count = 0;
  };

  /// A pause after which nothing is left of what was known of the motion.
  static constexpr std::int64_t kLongestBridge_us = 30'000'000;
  static constexpr std::int64_t kShortestDisturbance_us = 300'000;
  static constexpr std::int64_t kLongestDisturbance_us = 2'000'000;
  /// A pendulum that a hand moves, as an acceleration noise.
  static constexpr Scalar kHand_rad_s15 = 3;

  /// The gaps that can be used, each with what its noise makes of it.
  Measurements measure(const Sample& sample, Flags& flags) const {
    Measurements measured;
    for (std::size_t i = 0; i < rig_.layout.count; ++i) {
      if (!sample.has_reading(i)) {
        flags |= flag::kMissing;
        continue;
      }
      const Scalar volts = signal_v(sample.readings[i], acquisition_);
      const Response<Scalar>& response = rig_.responses[i];
      const GapReading<Scalar> reading = response.read(volts);
      Flags against = reading.flags;
      if (reading.gap_m && !beam_meets_disc(rig_.layout, i, *reading.gap_m, rig_.disc_diameter_m)) {
        against |= flag::kOutOfRange;
      }
      flags |= against;
      if (!reading.gap_m || against != 0 || (sample.flags & flag::kSaturated) != 0) {
        continue;
      }
      const Scalar by_volts = response.slope_m_per_v(volts) * rig_.noise[i].volts;
      measured.gap[measured.count++] = {
          .sensor = i,
          .gap_m = *reading.gap_m,
          .variance_m2 = by_volts * by_volts + rig_.noise[i].gap_m * rig_.noise[i].gap_m};
    }
    return measured;
  }

  /// Starts from the closed form; false where these gaps have none.
  bool begin(const Measurements& measured) {
    constexpr Scalar kAnyTheta_rad = 1;
    constexpr Scalar kAnyOmega_rad_s = 5;
    if (measured.count < rig_.layout.count) {
      return false;
    }
    std::array<Scalar, kMaxSensors> gap_m{};
    for (std::size_t i = 0; i < measured.count; ++i) {
      gap_m[i] = measured.gap[i].gap_m;
    }
    const auto found = inverse_.solve(std::span<const Scalar>(gap_m).first(measured.count));
    if (!found) {
      return false;
    }
    filter_.begin(angles_of(found->slopes), kAnyTheta_rad, kAnyOmega_rad_s);
    for (std::size_t i = 0; i < measured.count; ++i) {
      filter_.update(measured.gap[i], false);
    }
    watch_.reset();
    disturbed_until_us_ = std::nullopt;
    return true;
  }

  void follow(const Measurements& measured, std::int64_t t_us, Flags& flags) {
    constexpr Scalar kMicro = Scalar(1e-6);
    const auto elapsed_us = static_cast<std::int32_t>(t_us - last_t_us_);
    bool disturbed = disturbed_until_us_ && t_us < *disturbed_until_us_;
    const Scalar seconds = static_cast<Scalar>(elapsed_us) * kMicro;
    filter_.predict(
        seconds, disturbed ? kHand_rad_s15 : rig_.trust.acceleration_rad_s15 * distrust_.factor());
    for (std::size_t i = 0; i < measured.count; ++i) {
      using Verdict = typename InnovationWatch<Scalar>::Verdict;
      const Scalar square = filter_.innovation(measured.gap[i]).normalized_square();
      const Verdict verdict = watch_.judge(square);
      distrust_.learn(square, seconds / static_cast<Scalar>(measured.count));
      if (verdict == Verdict::kStray) {
        flags |= flag::kStray;
        continue;
      }
      if (verdict == Verdict::kDisturbed) {
        disturb(t_us);
        disturbed = true;
      }
      filter_.update(measured.gap[i], disturbed);
    }
    flags |= disturbed ? flag::kDisturbed : 0;
  }

  /// From now on the motion is anything; for longer, the sooner it comes again.
  void disturb(std::int64_t t_us) {
    constexpr Scalar kKick_rad = Scalar(0.05);
    constexpr Scalar kKick_rad_s = 2;
    const bool again = disturbed_until_us_ && t_us - *disturbed_until_us_ < kShortestDisturbance_us;
    disturbance_us_ =
        again ? std::min(2 * disturbance_us_, kLongestDisturbance_us) : kShortestDisturbance_us;
    disturbed_until_us_ = t_us + disturbance_us_;
    filter_.loosen(kKick_rad, kKick_rad_s);
  }

  void fill(const Measurements& measured, Estimate<Scalar>& estimate) const {
    const auto& state = filter_.state();
    const Angles<Scalar> angles{.theta1_rad = state[0], .theta2_rad = state[1]};
    estimate.attitude = {
        .angles = angles,
        .mass_m = rig_.pendulum.length_m * DiscPlane<Scalar>(slopes_of(angles)).rod()};
    estimate.omega_rad_s = {.first = state[2], .second = state[3]};
    estimate.sigma_rad = {.first = std::sqrt(filter_.variance(0)),
                          .second = std::sqrt(filter_.variance(1))};
    if (measured.count > 0) {
      Scalar squares = 0;
      for (std::size_t i = 0; i < measured.count; ++i) {
        const Scalar misfit = measured.gap[i].gap_m - filter_.gap_m(measured.gap[i].sensor);
        squares += misfit * misfit;
      }
      estimate.residual_m = std::sqrt(squares / static_cast<Scalar>(measured.count));
    }
  }

  Rig<Scalar> rig_;
  Acquisition<Scalar> acquisition_;
  GaussNewton<Scalar> inverse_;
  SwingFilter<Scalar> filter_;
  Continuity continuity_;
  InnovationWatch<Scalar> watch_;
  Distrust<Scalar> distrust_;
  std::optional<std::int64_t> disturbed_until_us_;
  std::int64_t disturbance_us_ = 0;
  std::int64_t last_t_us_ = 0;
  bool begun_ = false;
};

}  // namespace penduline
