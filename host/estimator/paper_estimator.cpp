// SPDX-License-Identifier: Apache-2.0
// Appendix A, step by step.
#include "host/estimator/paper_estimator.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <optional>
#include <variant>

namespace penduline {
namespace {

constexpr std::size_t kDroppedSamples = 28;             // me = 28
constexpr FilterDesign<double> kPaperFilter{15, 0.15};  // b = fir1(15, 0.15)

const LinearResponse<double>* linear(const Response<double>& response) {
  return std::get_if<LinearResponse<double>>(&response.model);
}

/// cx, cy, cz of Appendix A. Its y leaves the sphere of radius l (docs/paper.md, row 4).
Vector3<double> printed_position(const Angles<double>& angles, double length_m) {
  return length_m * Vector3<double>(-std::sin(angles.theta2_rad), std::sin(angles.theta1_rad),
                                    -std::cos(angles.theta2_rad) * std::cos(angles.theta1_rad));
}

}  // namespace

tl::expected<std::unique_ptr<Estimator>, Error> PaperEstimator::make(
    const Rig<double>& rig, const Acquisition<double>& acquisition, bool align) {
  if (rig.layout.count != kSensors) {
    return failure(
        fmt::format("--estimator paper needs two sensors, the rig has {}", rig.layout.count));
  }
  for (std::size_t i = 0; i < kSensors; ++i) {
    if (linear(rig.responses[i]) == nullptr) {
      return failure(
          fmt::format("--estimator paper needs linear responses, that of sensor {} is "
                      "another; --estimator gn takes any",
                      i + 1));
    }
  }
  return std::make_unique<PaperEstimator>(rig, acquisition, align);
}

PaperEstimator::PaperEstimator(const Rig<double>& rig, const Acquisition<double>& acquisition,
                               bool align)
    : rig_(rig),
      acquisition_(acquisition),
      align_(align),
      slope_m_per_v_{linear(rig.responses[0])->slope_m_per_v,
                     linear(rig.responses[1])->slope_m_per_v},
      inverse_(rig.layout),
      continuity_(acquisition.longest_step_us()) {
  const FirTaps<double> taps = design_lowpass(rig.filter.value_or(kPaperFilter));
  filters_.fill(FirFilter<double>(taps));
  moment_ = WindowMoment(taps.count, acquisition.period_us());
  window_flags_ = WindowFlags(taps.count);
}

tl::expected<void, Error> PaperEstimator::take(const Sample& sample, EstimateSink& /*sink*/) {
  FilteredSample filtered{.t_us = sample.t_us,
                          .seq = sample.seq,
                          .volts = {},
                          .flags = sample.flags | continuity_.follow(sample).flags |
                                   window_flags_.push(sample.flags & flag::kSaturated)};
  const std::int64_t moment_us = moment_.push(sample.t_us);
  if (align_) {
    filtered.t_us = moment_us;
  }
  for (std::size_t i = 0; i < kSensors; ++i) {
    if (!sample.has_reading(i)) {
      return failure(
          fmt::format("seq {}: a reading is missing, and --estimator paper needs them "
                      "all; --estimator gn does not",
                      sample.seq));
    }
    filtered.volts[i] = filters_[i].push(signal_v(sample.readings[i], acquisition_));
  }
  samples_.push_back(filtered);
  return {};
}

std::array<double, PaperEstimator::kSensors> PaperEstimator::mean_volts() const {
  std::array<double, kSensors> sums{};
  for (std::size_t i = kDroppedSamples; i < samples_.size(); ++i) {
    for (std::size_t sensor = 0; sensor < kSensors; ++sensor) {
      sums[sensor] += samples_[i].volts[sensor];
    }
  }
  const auto count = static_cast<double>(samples_.size() - kDroppedSamples);
  return {sums[0] / count, sums[1] / count};
}

tl::expected<void, Error> PaperEstimator::finish(EstimateSink& sink) {
  if (samples_.size() <= kDroppedSamples) {
    return failure(
        fmt::format("found {} samples, --estimator paper needs more than the {} that it "
                    "drops",
                    samples_.size(), kDroppedSamples));
  }
  const std::array<double, kSensors> means = mean_volts();
  std::vector<std::optional<Angles<double>>> solved(samples_.size());
  Angles<double> sum;
  std::size_t count = 0;
  for (std::size_t i = kDroppedSamples; i < samples_.size(); ++i) {
    // dz = -scale * (filtered - mean) - 0.02; its rest position -0.02 is where rises count from.
    std::array<double, kSensors> rise_m{};
    for (std::size_t sensor = 0; sensor < kSensors; ++sensor) {
      rise_m[sensor] = -slope_m_per_v_[sensor] * (samples_[i].volts[sensor] - means[sensor]);
    }
    if (const auto result = inverse_.solve(rise_m)) {
      solved[i] = angles_of(result->slopes);
      if (result->conditioning < kLeastConditioning<double>) {
        samples_[i].flags |= flag::kIllConditioned;
      }
      sum.theta1_rad += solved[i]->theta1_rad;
      sum.theta2_rad += solved[i]->theta2_rad;
      ++count;
    }
  }
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    Estimate<double> estimate{
        .t_us = samples_[i].t_us, .seq = samples_[i].seq, .flags = samples_[i].flags};
    if (solved[i]) {
      const Angles<double> angles{
          solved[i]->theta1_rad - sum.theta1_rad / static_cast<double>(count),
          solved[i]->theta2_rad - sum.theta2_rad / static_cast<double>(count)};
      estimate.attitude = {angles, printed_position(angles, rig_.pendulum.length_m)};
    } else {
      estimate.flags |= i < kDroppedSamples ? flag::kFilling : flag::kNoSolution;
    }
    if (auto taken = sink.take(estimate); !taken) {
      return taken;
    }
  }
  return {};
}

}  // namespace penduline
