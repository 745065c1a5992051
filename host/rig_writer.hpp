// SPDX-License-Identifier: Apache-2.0
// Writes a rig file anew with some of its numbers changed.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <tl/expected.hpp>

#include "common/rig.hpp"
#include "hal/error.hpp"
#include "host/calibration_section.hpp"

namespace penduline {

/// What a calibration changes of a rig; the rest stays.
struct RigChanges {
  std::optional<double> disc_offset_m{};
  std::array<std::optional<Vector3<double>>, kMaxSensors> positions_m{};
  std::array<std::optional<Response<double>>, kMaxSensors> responses{};
  std::array<std::optional<double>, kMaxSensors> noise_v{};
};

/// The rig with the changes made.
[[nodiscard]] Rig<double> changed(Rig<double> rig, const RigChanges& changes);

/// The text of the rig file at `path` with the changes and the record of where they come from.
/// Every other key stays, also such as this program does not know; comments are lost. Fails where
/// the file cannot be read, and where what came of it is no rig.
[[nodiscard]] tl::expected<std::string, Error> rewritten_rig(const std::string& path,
                                                             const RigChanges& changes,
                                                             const CalibrationRecord& record);

}  // namespace penduline
