// SPDX-License-Identifier: Apache-2.0
// The rig: the apparatus and its numbers, as the pipeline needs them.
#pragma once

#include <array>
#include <optional>

#include "common/disc_plane.hpp"
#include "common/dynamics.hpp"
#include "common/filter_trust.hpp"
#include "common/fir.hpp"
#include "common/response.hpp"
#include "common/sample.hpp"

namespace penduline {

template <class Scalar>
struct Rig {
  Pendulum<Scalar> pendulum;
  Scalar disc_diameter_m = Scalar(0.12);
  SensorLayout<Scalar> layout;
  std::array<Response<Scalar>, kMaxSensors> responses{};  ///< in the layout's order
  std::optional<FilterDesign<Scalar>> filter;             ///< none: `default_filter`
  std::array<SensorNoise<Scalar>, kMaxSensors> noise{};   ///< in the layout's order
  FilterTrust<Scalar> trust{};                            ///< of the Kalman filter
};

}  // namespace penduline
