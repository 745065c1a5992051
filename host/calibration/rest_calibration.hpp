// SPDX-License-Identifier: Apache-2.0
// The zero: from a pendulum that hangs still.
#pragma once

#include <tl/expected.hpp>
#include <vector>

#include "hal/error.hpp"
#include "host/calibration/calibration.hpp"
#include "host/calibration/signal_log.hpp"
#include "host/rig_file.hpp"

namespace penduline {

/// What makes a sensor read 0 at rest again.
enum class ZeroOf {
  kHeight,    ///< the mounting: the sensor's height
  kResponse,  ///< the sensor: its response shifts by a gap
  kGain,      ///< its light: its response's signal changes by a factor
};

/// Zeroes each sensor by the recordings' mean signal. Fails where the pendulum moves, drifts, or
/// its signal is too noisy for a zero, saying by how much.
[[nodiscard]] tl::expected<Calibration, Error> calibrate_rest(const RigFile& rig,
                                                              const std::vector<SignalLog>& logs,
                                                              ZeroOf zero_of);

}  // namespace penduline
