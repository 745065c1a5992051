// SPDX-License-Identifier: Apache-2.0
// What a session counted: samples, losses, flags, and the rate that was really held.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/continuity.hpp"
#include "common/estimate.hpp"
#include "common/flags.hpp"
#include "common/sample.hpp"
#include "host/flag_counts.hpp"

namespace penduline {

class Summary {
 public:
  explicit Summary(const Acquisition<double>& acquisition)
      : nominal_hz_(acquisition.rate_hz), continuity_(acquisition.longest_step_us()) {}

  void count(const Sample& sample);
  /// Counts an estimate and returns its flags that had not been seen before.
  Flags count(const Estimate<double>& estimate);
  /// Counts rows that did not come through an output.
  void count_dropped(const std::string& output, std::uint64_t rows);

  [[nodiscard]] std::uint64_t samples() const { return samples_; }
  /// Estimates with angles.
  [[nodiscard]] std::uint64_t with_angles() const { return with_angles_; }
  [[nodiscard]] std::uint64_t lost() const { return lost_; }
  /// How many estimates had a flag of kFlagDescriptions.
  [[nodiscard]] std::uint64_t flagged(Flags bit) const { return flagged_.of(bit); }
  /// Mean rate over the steps from one number to the next: those without pauses or, where most
  /// steps are too long for the nominal rate, those. None before two samples in a row.
  [[nodiscard]] std::optional<double> rate_hz() const;

  /// In words, that the samples come at another rate than the nominal one, which the filters are
  /// made for; none where they are within 10 %.
  [[nodiscard]] std::optional<std::string> rate_complaint() const;

  /// In words, that the rig may have its noise too small; none where at most a tenth of the
  /// estimates, or fewer than 20, are `disturbed`.
  [[nodiscard]] std::optional<std::string> noise_complaint() const;

  /// Whether any flag but the ordinary ones was seen.
  [[nodiscard]] bool has_problems() const { return (seen_ & ~flag::kOrdinary) != 0; }

  /// In words, for a person: "463 samples at 20.000 Hz, 0 lost, 448 with angles; flagged: ...;
  /// dropped: 12 rows by standard output".
  [[nodiscard]] std::string text() const;

 private:
  double nominal_hz_;
  std::uint64_t samples_ = 0;
  std::uint64_t lost_ = 0;
  std::uint64_t with_angles_ = 0;
  std::uint64_t estimates_ = 0;
  FlagCounts flagged_;
  Flags seen_ = 0;
  Continuity continuity_;
  std::int64_t last_t_us_ = 0;
  /// Steps from one number to the next, and their time.
  struct Steps {
    std::uint64_t count = 0;
    std::int64_t us = 0;
  };
  Steps unbroken_;
  Steps paused_;
  std::vector<std::pair<std::string, std::uint64_t>> dropped_;  ///< by outputs
};

}  // namespace penduline
