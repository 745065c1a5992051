// SPDX-License-Identifier: Apache-2.0
// Responses from a free swing, by the pendulum's own dynamics.
#pragma once

#include <optional>
#include <tl/expected.hpp>
#include <vector>

#include "hal/error.hpp"
#include "host/calibration/calibration.hpp"
#include "host/calibration/response_curve.hpp"
#include "host/calibration/signal_fit.hpp"
#include "host/calibration/signal_log.hpp"
#include "host/rig_file.hpp"

namespace penduline {

struct SwingOptions {
  CurveKind curve = CurveKind::kLogPolynomial;
  std::optional<double> length_m{};  ///< effective; else the rig's, to within 2 %
  std::optional<Release> release{};
};

/// How well the rig's own length and a length given for the calibration are taken to be known.
inline constexpr double kRigLengthShare = 0.02;
inline constexpr double kGivenLengthShare = 0.001;

/// Fits each sensor's response, the pendulum and the swings' starts together. Heights stay: only a
/// response and a height together can be told from a swing. Fails, saying why, where the recordings
/// do not determine the angles or no pendulum swings so.
[[nodiscard]] tl::expected<Calibration, Error> calibrate_swing(const RigFile& rig,
                                                               const std::vector<SignalLog>& logs,
                                                               const SwingOptions& options);

}  // namespace penduline
