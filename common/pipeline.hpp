// SPDX-License-Identifier: Apache-2.0
// The pipeline from sample to estimate: filter, response, inverse (the estimator `gn`).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "common/continuity.hpp"
#include "common/disc_plane.hpp"
#include "common/estimate.hpp"
#include "common/fir.hpp"
#include "common/gauss_newton.hpp"
#include "common/rig.hpp"
#include "common/sample.hpp"
#include "common/window_flags.hpp"
#include "common/window_moment.hpp"

namespace penduline {

/// The estimate's angles and position for known slopes.
template <class Scalar>
[[nodiscard]] typename Estimate<Scalar>::Attitude attitude_of(const Slopes<Scalar>& slopes,
                                                              Scalar length_m) {
  return {.angles = angles_of(slopes), .mass_m = length_m * DiscPlane<Scalar>(slopes).rod()};
}

/// Turns samples into estimates, one for one, without heap, clock or I/O: the same samples give the
/// same estimates live, replayed, simulated and on the board.
template <class Scalar>
class Pipeline {
 public:
  /// The rig's sensors must determine the tilt and be as many as the acquisition's.
  Pipeline(const Rig<Scalar>& rig, const Acquisition<Scalar>& acquisition)
      : rig_(rig),
        acquisition_(acquisition),
        inverse_(rig.layout),
        continuity_(acquisition.longest_step_us()) {
    const FirTaps<Scalar> taps = design_lowpass(
        rig.filter.value_or(default_filter(acquisition.rate_hz, small_swing_hz(rig.pendulum))));
    for (FirFilter<Scalar>& filter : filters_) {
      filter.use(taps);
    }
    moment_ = WindowMoment(taps.count, acquisition.period_us());
    window_flags_ = WindowFlags(taps.count);
  }

  /// Takes the next sample and returns its estimate (method.md, "From sample to estimate").
  Estimate<Scalar> update(const Sample& sample) {
    const Continuity::Verdict verdict = continuity_.follow(sample);
    if (!verdict.unbroken) {
      start_over();
    }
    Estimate<Scalar> estimate{.seq = sample.seq, .flags = sample.flags | verdict.flags};
    const Signals signals = filter(sample, estimate.flags);
    estimate.t_us = moment_.push(sample.t_us);
    const Gaps gaps = read_gaps(signals, estimate.flags);
    if (gaps.count >= 2) {
      solve(gaps, estimate);
    }
    return estimate;
  }

 private:
  struct Signals {
    std::array<std::optional<Scalar>, kMaxSensors> volts{};
  };
  /// The gaps that are known, with the sensors that they belong to.
  struct Gaps {
    std::array<Scalar, kMaxSensors> gap_m{};
    std::array<std::size_t, kMaxSensors> sensor{};
    std::size_t count = 0;
  };

  void start_over() {
    for (FirFilter<Scalar>& filter : filters_) {
      filter.clear();
    }
    moment_.clear();
    window_flags_.clear();
  }

  Signals filter(const Sample& sample, Flags& flags) {
    Signals signals;
    // What spoils a sample spoils every estimate that it goes into.
    Flags spoiling = sample.flags & flag::kSaturated;
    for (std::size_t i = 0; i < rig_.layout.count; ++i) {
      if (!sample.has_reading(i)) {
        filters_[i].clear();
        flags |= flag::kMissing;
        continue;
      }
      const Scalar volts = signal_v(sample.readings[i], acquisition_);
      spoiling |= rig_.responses[i].read(volts).flags;
      const Scalar filtered = filters_[i].push(volts);
      if (filters_[i].full()) {
        signals.volts[i] = filtered;
      } else {
        flags |= flag::kFilling;
      }
    }
    flags |= window_flags_.push(spoiling);
    return signals;
  }

  Gaps read_gaps(const Signals& signals, Flags& flags) const {
    Gaps gaps;
    for (std::size_t i = 0; i < rig_.layout.count; ++i) {
      if (!signals.volts[i]) {
        continue;
      }
      const GapReading<Scalar> reading = rig_.responses[i].read(*signals.volts[i]);
      flags |= reading.flags;
      if (!reading.gap_m) {
        continue;
      }
      if (!beam_meets_disc(rig_.layout, i, *reading.gap_m, rig_.disc_diameter_m)) {
        flags |= flag::kOutOfRange;
      }
      gaps.gap_m[gaps.count] = *reading.gap_m;
      gaps.sensor[gaps.count] = i;
      ++gaps.count;
    }
    return gaps;
  }

  void solve(const Gaps& gaps, Estimate<Scalar>& estimate) const {
    // Of three or more sensors some may be without a gap: the others answer if they can.
    const auto result =
        gaps.count == rig_.layout.count
            ? inverse_.solve(gaps.gap_m)
            : solve_with_some<Scalar>(rig_.layout, std::span(gaps.sensor).first(gaps.count),
                                      std::span(gaps.gap_m).first(gaps.count));
    if (!result) {
      estimate.flags |= flag::kNoSolution;
      return;
    }
    if (result->conditioning < kLeastConditioning<Scalar>) {
      estimate.flags |= flag::kIllConditioned;
    }
    estimate.attitude = attitude_of(result->slopes, rig_.pendulum.length_m);
    estimate.residual_m = result->residual_m;
  }

  Rig<Scalar> rig_;
  Acquisition<Scalar> acquisition_;
  GaussNewton<Scalar> inverse_;
  std::array<FirFilter<Scalar>, kMaxSensors> filters_;
  WindowMoment moment_;
  WindowFlags window_flags_;
  Continuity continuity_;
};

}  // namespace penduline
