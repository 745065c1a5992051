// SPDX-License-Identifier: Apache-2.0
// The numbers of a rig's geometry that a fit looks for, as long as the data tell them.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/calibration/calibration.hpp"
#include "host/calibration/signal_fit.hpp"
#include "host/rig_file.hpp"

namespace penduline {

/// The disc's offset, and of each sensor x, y and its gap at rest, which with the offset is its
/// height: free, or held where the rig has them.
class GeometryNumbers {
 public:
  explicit GeometryNumbers(const RigFile& rig);

  /// Those that are free, in the order of the fit's numbers.
  [[nodiscard]] std::vector<Unknown> unknowns() const;
  [[nodiscard]] const std::vector<std::string>& held() const { return held_; }
  [[nodiscard]] std::size_t free_count() const { return free_.size(); }

  /// The gap under a sensor.
  [[nodiscard]] double gap_m(std::span<const double> numbers, std::size_t sensor,
                             const DiscPlane<double>& plane) const;

  /// Holds the first number whose sigma says that the data do not tell it: offset first, then the
  /// places, then the gaps at rest, which all data tell best. False where there is none.
  bool hold_undetermined(std::span<const double> sigmas);

  [[nodiscard]] RigChanges changes(std::span<const double> numbers, std::size_t sensor_count) const;

 private:
  struct Number {
    std::string name;
    double start_m = 0;
    double coarsest_m = 0;  ///< sigma above which it stays as it is
  };

  [[nodiscard]] double value(std::span<const double> numbers, std::size_t number) const {
    return place_[number] ? numbers[*place_[number]] : numbers_[number].start_m;
  }
  void number_places();

  std::vector<Number> numbers_;
  std::vector<std::size_t> free_;                  ///< indices of numbers_
  std::vector<std::optional<std::size_t>> place_;  ///< of each number among the free ones
  std::vector<std::string> held_;
  std::array<std::array<std::size_t, 3>, kMaxSensors> of_sensor_{};
};

}  // namespace penduline
