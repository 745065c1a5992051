// SPDX-License-Identifier: Apache-2.0
// The paper's Appendix A to the letter, offline: what our estimators are compared with.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <tl/expected.hpp>
#include <vector>

#include "common/closed_form.hpp"
#include "common/continuity.hpp"
#include "common/fir.hpp"
#include "common/window_flags.hpp"
#include "common/window_moment.hpp"
#include "host/estimator/estimator.hpp"

namespace penduline {

/// Appendix A: filter both signals, drop 28 samples, remove the means, scale, add the rest
/// position, solve, remove the mean angles. Keeps 48 bytes a sample in memory until the end
/// (docs/paper.md). The six equations are solved by the closed form, which has the same root.
class PaperEstimator final : public Estimator {
 public:
  /// Fails unless the rig has two sensors with `linear` responses.
  static tl::expected<std::unique_ptr<Estimator>, Error> make(
      const Rig<double>& rig, const Acquisition<double>& acquisition, bool align);

  PaperEstimator(const Rig<double>& rig, const Acquisition<double>& acquisition, bool align);

  /// Fails on a missing reading: a mean over the rest would mean something else.
  tl::expected<void, Error> take(const Sample& sample, EstimateSink& sink) override;
  /// Fails where no sample is left after the first 28.
  tl::expected<void, Error> finish(EstimateSink& sink) override;

 private:
  static constexpr std::size_t kSensors = 2;

  struct FilteredSample {
    std::int64_t t_us;
    std::uint64_t seq;
    std::array<double, kSensors> volts;
    Flags flags;
  };

  [[nodiscard]] std::array<double, kSensors> mean_volts() const;

  Rig<double> rig_;
  Acquisition<double> acquisition_;
  bool align_;
  std::array<double, kSensors> slope_m_per_v_;
  std::array<FirFilter<double>, kSensors> filters_;
  WindowMoment moment_;
  WindowFlags window_flags_;
  ClosedForm<double> inverse_;
  Continuity continuity_;
  std::vector<FilteredSample> samples_;
};

}  // namespace penduline
