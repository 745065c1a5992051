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
#include "common/estimate.hpp"
#include "common/flags.hpp"
#include "common/gap_measurement.hpp"
#include "common/gauss_newton.hpp"
#include "common/innovation_watch.hpp"
#include "common/motion_noise.hpp"
#include "common/rig.hpp"
#include "common/sample.hpp"
#include "common/swing_estimate.hpp"
#include "common/swing_filter.hpp"

namespace penduline {

/// What sees a sample's gaps, and a tracker's filter between prediction and them: nobody, but for a
/// smoother.
struct NoWitness {
  template <class Measurements>
  void measured(const Measurements& /*gaps*/) {}
  template <class Transition, class Filter>
  void predicted(const Transition& /*transition*/, const Filter& /*filter*/) {}
};

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
        continuity_(acquisition.longest_step_us()),
        noise_(rig.trust.acceleration_rad_s15) {}

  /// Takes the next sample and returns its estimate. `witness` sees the filter on the way.
  template <class Witness = NoWitness>
  Estimate<Scalar> update(const Sample& sample, Witness&& witness = {}) {
    const Continuity::Verdict verdict = continuity_.follow(sample);
    Estimate<Scalar> estimate{
        .t_us = sample.t_us, .seq = sample.seq, .flags = sample.flags | verdict.flags};
    const GapMeasurements<Scalar> measured =
        measure_gaps(rig_, acquisition_, sample, estimate.flags);
    witness.measured(measured);
    const bool other_time = (estimate.flags & (flag::kRestarted | flag::kOutOfOrder)) != 0 ||
                            sample.t_us - last_t_us_ > kLongestBridgeUs;
    if (!begun_ || other_time) {
      begun_ = begin(measured);
    } else {
      follow(measured, sample.t_us, estimate.flags, witness);
    }
    begun_ = begun_ && filter_.is_sound();
    last_t_us_ = sample.t_us;
    if (begun_) {
      put_state(rig_, filter_.state(),
                {.first = filter_.variance(0), .second = filter_.variance(1)}, measured, estimate);
    } else {
      estimate.flags |= flag::kNoSolution;
    }
    return estimate;
  }

  [[nodiscard]] const SwingFilter<Scalar>& filter() const { return filter_; }

 private:
  /// A pause after which nothing is left of what was known of the motion.
  static constexpr std::int64_t kLongestBridgeUs = 30'000'000;

  /// The tilt that these gaps alone give, if they do: three or more sensors can spare one.
  std::optional<InverseResult<Scalar>> solve(const GapMeasurements<Scalar>& measured) const {
    std::array<Scalar, kMaxSensors> gap_m{};
    std::array<std::size_t, kMaxSensors> sensor{};
    for (std::size_t i = 0; i < measured.count; ++i) {
      gap_m[i] = measured.gap[i].gap_m;
      sensor[i] = measured.gap[i].sensor;
    }
    const auto gaps = std::span<const Scalar>(gap_m).first(measured.count);
    return measured.count == rig_.layout.count
               ? inverse_.solve(gaps)
               : solve_with_some<Scalar>(rig_.layout, std::span(sensor).first(measured.count),
                                         gaps);
  }

  /// Starts from the closed form; false where these gaps have none.
  bool begin(const GapMeasurements<Scalar>& measured) {
    constexpr Scalar kAnyThetaRad = 1;
    constexpr Scalar kAnyOmegaRadPerS = 5;
    const auto found = solve(measured);
    if (!found) {
      return false;
    }
    filter_.begin(angles_of(found->slopes), kAnyThetaRad, kAnyOmegaRadPerS);
    for (std::size_t i = 0; i < measured.count; ++i) {
      filter_.update(measured.gap[i], false);
    }
    watch_.reset();
    noise_.reset();
    return true;
  }

  template <class Witness>
  void follow(const GapMeasurements<Scalar>& measured, std::int64_t t_us, Flags& flags,
              Witness& witness) {
    constexpr Scalar kMicro = Scalar(1e-6);
    constexpr Scalar kKickRad = Scalar(0.05);
    constexpr Scalar kKickRadPerS = 2;
    const auto elapsed_us = static_cast<std::int32_t>(t_us - last_t_us_);
    const Scalar seconds = static_cast<Scalar>(elapsed_us) * kMicro;
    const auto transition = filter_.predict(
        seconds, noise_.rad_s15(), rig_.trust.damping_walk_per_s15 * noise_.damping_factor());
    std::array<bool, kMaxSensors> stray{};
    for (std::size_t i = 0; i < measured.count; ++i) {
      using Verdict = typename InnovationWatch<Scalar>::Verdict;
      const Scalar square = filter_.innovation(measured.gap[i]).normalized_square();
      const Verdict verdict = watch_.judge(square);
      noise_.learn(square, seconds / static_cast<Scalar>(measured.count));
      stray[i] = verdict == Verdict::kStray;
      if (verdict == Verdict::kDisturbed) {
        filter_.loosen(kKickRad, kKickRadPerS);
        noise_.jump();
      }
    }
    witness.predicted(transition, filter_);
    for (std::size_t i = 0; i < measured.count; ++i) {
      if (stray[i]) {
        flags |= flag::kStray;
      } else {
        filter_.update(measured.gap[i], noise_.disturbed());
      }
    }
    flags |= noise_.disturbed() ? flag::kDisturbed : 0;
  }

  Rig<Scalar> rig_;
  Acquisition<Scalar> acquisition_;
  GaussNewton<Scalar> inverse_;
  SwingFilter<Scalar> filter_;
  Continuity continuity_;
  InnovationWatch<Scalar> watch_;
  MotionNoise<Scalar> noise_;
  std::int64_t last_t_us_ = 0;
  bool begun_ = false;
};

}  // namespace penduline
