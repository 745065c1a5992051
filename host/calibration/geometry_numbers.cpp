// SPDX-License-Identifier: Apache-2.0
// Which numbers of the geometry are free, and what they mean for a gap.
#include "host/calibration/geometry_numbers.hpp"

#include <array>
#include <cmath>

namespace penduline {
namespace {

/// How far a ruler may be off.
constexpr double kPriorM = 3e-3;
constexpr double kScaleM = 1e-4;

}  // namespace

GeometryNumbers::GeometryNumbers(const RigFile& rig) {
  constexpr double kCoarsestOffsetM = 0.5e-3;
  constexpr double kCoarsestPlaceM = 0.3e-3;
  constexpr double kCoarsestRestM = 0.1e-3;
  constexpr std::array<const char*, 3> kAxes = {"x_m", "y_m", "rest_gap_m"};
  const SensorLayout<double>& layout = rig.rig.layout;
  numbers_.push_back(
      {.name = "disc offset_m", .start_m = layout.disc_offset_m, .coarsest_m = kCoarsestOffsetM});
  for (std::size_t i = 0; i < layout.count; ++i) {
    const Vector3<double>& position = layout.position_m[i];
    // Across the sensor's own direction first: a turn of everything about the vertical shows
    // nowhere, and where it is held is a choice.
    const Eigen::Index along = std::abs(position.y()) > std::abs(position.x()) ? 1 : 0;
    for (const Eigen::Index axis : {1 - along, along}) {
      of_sensor_[i][static_cast<std::size_t>(axis)] = numbers_.size();
      numbers_.push_back({.name = rig.sensor_names[i] + " " + kAxes[static_cast<std::size_t>(axis)],
                          .start_m = position[axis],
                          .coarsest_m = kCoarsestPlaceM});
    }
  }
  for (std::size_t i = 0; i < layout.count; ++i) {
    of_sensor_[i][2] = numbers_.size();
    numbers_.push_back({.name = rig.sensor_names[i] + " " + kAxes[2],
                        .start_m = layout.position_m[i].z() + layout.disc_offset_m,
                        .coarsest_m = kCoarsestRestM});
  }
  for (std::size_t i = 0; i < numbers_.size(); ++i) {
    free_.push_back(i);
  }
  number_places();
}

void GeometryNumbers::number_places() {
  place_.assign(numbers_.size(), std::nullopt);
  for (std::size_t i = 0; i < free_.size(); ++i) {
    place_[free_[i]] = i;
  }
}

std::vector<Unknown> GeometryNumbers::unknowns() const {
  std::vector<Unknown> unknowns;
  for (const std::size_t i : free_) {
    unknowns.push_back(
        {{.name = numbers_[i].name, .start = numbers_[i].start_m, .scale = kScaleM}, kPriorM});
  }
  return unknowns;
}

double GeometryNumbers::gap_m(std::span<const double> numbers, std::size_t sensor,
                              const DiscPlane<double>& plane) const {
  const auto& [x, y, rest] = of_sensor_[sensor];
  return value(numbers, rest) -
         plane.rise_m(value(numbers, x), value(numbers, y), value(numbers, 0));
}

bool GeometryNumbers::hold_undetermined(std::span<const double> sigmas) {
  for (std::size_t i = 0; i < free_.size(); ++i) {
    const Number& number = numbers_[free_[i]];
    if (!(sigmas[i] <= number.coarsest_m)) {
      held_.push_back(number.name);
      free_.erase(free_.begin() + static_cast<std::ptrdiff_t>(i));
      number_places();
      return true;
    }
  }
  return false;
}

RigChanges GeometryNumbers::changes(std::span<const double> numbers,
                                    std::size_t sensor_count) const {
  RigChanges changes;
  const double offset_m = value(numbers, 0);
  if (place_[0]) {
    changes.disc_offset_m = offset_m;
  }
  for (std::size_t i = 0; i < sensor_count; ++i) {
    const auto& [x, y, rest] = of_sensor_[i];
    if (place_[0] || place_[x] || place_[y] || place_[rest]) {
      changes.positions_m[i] = {value(numbers, x), value(numbers, y),
                                value(numbers, rest) - offset_m};
    }
  }
  return changes;
}

}  // namespace penduline
