// SPDX-License-Identifier: Apache-2.0
// From recordings of a free swing to what a fit begins with.
#pragma once

#include <optional>
#include <tl/expected.hpp>
#include <vector>

#include "common/rig.hpp"
#include "hal/error.hpp"
#include "host/calibration/signal_fit.hpp"
#include "host/calibration/signal_log.hpp"

namespace penduline {

/// Each sensor's signal as its recordings have it at rest: the median, since the disc passes its
/// rest as often one way as the other.
[[nodiscard]] std::array<double, kMaxSensors> rest_signals(const std::vector<SignalLog>& logs,
                                                           std::size_t sensor_count);

/// Reads each recording by the rig's responses, whose signals are taken `gain` times as strong,
/// well enough to begin a fit. At most some 32 samples a period are kept. Fails where a recording
/// is shorter than five periods or shows no swing.
[[nodiscard]] tl::expected<std::vector<SwingData>, Error> swing_data(
    const std::vector<SignalLog>& logs, const Rig<double>& rig,
    const std::array<double, kMaxSensors>& gain, const std::optional<Release>& release);

}  // namespace penduline
