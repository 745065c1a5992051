// SPDX-License-Identifier: Apache-2.0
// What every calibration by a free swing asks of its recordings and of its fit.
#pragma once

#include <cstddef>
#include <string>
#include <tl/expected.hpp>
#include <vector>

#include "hal/error.hpp"
#include "host/calibration/calibration.hpp"
#include "host/calibration/signal_fit.hpp"
#include "host/calibration/signal_log.hpp"
#include "host/rig_file.hpp"

namespace penduline {

/// Refuses swings of which a sensor's signals are doubtful for more than a quarter: so near that
/// they fold back, or not to be read at all.
[[nodiscard]] tl::expected<void, Error> require_beyond_fold(const RigFile& rig,
                                                            const std::vector<SwingData>& swings);

/// Refuses swings that the fit does not describe, or a release that is not in the recording.
[[nodiscard]] tl::expected<void, Error> require_good_swing(const SignalFit& fit,
                                                           const std::vector<SignalLog>& logs,
                                                           const Pendulum<double>& pendulum);

/// Warns of a sensor's samples that the fit has left out; refuses more than a quarter of them.
/// `where` says at which gaps samples are left out: "nearer than 3 mm". `path` is for messages.
[[nodiscard]] tl::expected<void, Error> account_for_left_out(const RigFile& rig, std::size_t sensor,
                                                             const SignalFit& fit,
                                                             const std::string& where,
                                                             const std::string& path,
                                                             Calibration& result);

/// Puts a fit's numbers into the record, and says which frictions are held at 0.
void put_numbers(const SignalFit& fit, Calibration& result);

}  // namespace penduline
