// SPDX-License-Identifier: Apache-2.0
// Where the sensors stand and how far the disc is from the pivot, as far as the data can tell.
#pragma once

#include <tl/expected.hpp>
#include <vector>

#include "hal/error.hpp"
#include "host/calibration/calibration.hpp"
#include "host/calibration/points_table.hpp"
#include "host/calibration/signal_log.hpp"
#include "host/calibration/swing_calibration.hpp"
#include "host/rig_file.hpp"

namespace penduline {

/// From points at known tilts, by the rig's responses. What they do not tell stays and is named.
/// Fails where they tell nothing or contradict the responses.
[[nodiscard]] tl::expected<Calibration, Error> calibrate_geometry(const RigFile& rig,
                                                                  const SensorPoints& points);

/// The same from free swings, by the pendulum's dynamics. How everything is turned about the
/// vertical shows nowhere: the first sensor's direction stays.
[[nodiscard]] tl::expected<Calibration, Error> calibrate_geometry(
    const RigFile& rig, const std::vector<SignalLog>& logs, const SwingOptions& options);

}  // namespace penduline
