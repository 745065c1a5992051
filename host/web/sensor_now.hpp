// SPDX-License-Identifier: Apache-2.0
// What one sample says of one sensor's light and signal.
#pragma once

#include <cstddef>
#include <optional>

#include "common/rig.hpp"
#include "common/sample.hpp"

namespace penduline {

struct SensorNow {
  std::optional<double> ambient_v{};      ///< none where the board cannot switch its emitters
  std::optional<double> signal_v{};       ///< none where the sample has no reading
  std::optional<bool> saturated = false;  ///< none: one sensor is, and the means do not tell which
  bool out_of_range = false;              ///< of its response
};

/// Of the rig's sensor number `i`, from 0.
[[nodiscard]] SensorNow sensor_now(const Rig<double>& rig, const Acquisition<double>& acquisition,
                                   const Sample& sample, std::size_t i);

}  // namespace penduline
