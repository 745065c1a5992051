// SPDX-License-Identifier: Apache-2.0
// What a session counted: samples, losses, flags, and the rate that was really held.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "common/continuity.hpp"
#include "common/estimate.hpp"
#include "common/flags.hpp"
#include "common/sample.hpp"

namespace penduline {

class Summary {
 public:
  void count(const Sample& sample);
  /// Counts an estimate and returns its flags that had not been seen before.
  Flags count(const Estimate<double>& estimate);

  /// Whether any flag but the ordinary ones was seen.
  [[nodiscard]] bool has_problems() const { return (seen_ & ~flag::kOrdinary) != 0; }

  /// In words, for a person: "463 samples in 23.100 s (20.000 Hz), 448 with angles; ...".
  [[nodiscard]] std::string text() const;

 private:
  /// Mean rate over the unbroken stretches; none before two samples in a row.
  [[nodiscard]] std::optional<double> rate_hz() const;

  std::uint64_t samples_ = 0;
  std::uint64_t lost_ = 0;
  std::uint64_t with_angles_ = 0;
  std::array<std::uint64_t, kFlagDescriptions.size()> flagged_{};
  Flags seen_ = 0;
  Continuity continuity_;
  std::int64_t last_t_us_ = 0;
  std::int64_t unbroken_us_ = 0;
  std::uint64_t unbroken_steps_ = 0;
};

}  // namespace penduline
