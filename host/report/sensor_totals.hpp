// SPDX-License-Identifier: Apache-2.0
// What a whole recording says of each sensor's light and signal.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/rig.hpp"
#include "common/sample.hpp"

namespace penduline {

struct SensorTotal {
  std::uint64_t saturated = 0;        ///< samples, as are the others
  std::uint64_t maybe_saturated = 0;  ///< one sensor was, and the means do not tell which
  std::uint64_t out_of_range = 0;
  std::uint64_t missing = 0;  ///< without a reading
  /// The least and the greatest; none where the board cannot switch its emitters.
  std::optional<std::pair<double, double>> ambient_v{};
};

class SensorTotals {
 public:
  SensorTotals(const Rig<double>& rig, const Acquisition<double>& acquisition)
      : rig_(rig), acquisition_(acquisition), totals_(rig.layout.count) {}

  void take(const Sample& sample);

  /// In the rig's order.
  [[nodiscard]] const std::vector<SensorTotal>& totals() const { return totals_; }
  /// An array of objects with the members' names; `ambient_v` is null or [least, greatest].
  [[nodiscard]] std::string json() const;

 private:
  const Rig<double>& rig_;
  Acquisition<double> acquisition_;
  std::vector<SensorTotal> totals_;
};

}  // namespace penduline
