// SPDX-License-Identifier: Apache-2.0
// A rig as the bytes that are uploaded to a board.
#pragma once

#include <cstdint>
#include <string>
#include <tl/expected.hpp>
#include <vector>

#include "common/rig.hpp"
#include "common/wire/choices.hpp"
#include "hal/error.hpp"

namespace penduline {

/// The rig in the board's single precision.
[[nodiscard]] Rig<float> narrowed(const Rig<double>& rig);

/// The image of a rig that a board is to use by an estimator (docs/protocol.md). Fails where it is
/// too large for a board or, after rounding to single precision, none that works; `name` stands for
/// the rig in the message.
[[nodiscard]] tl::expected<std::vector<std::uint8_t>, Error> rig_image(
    const Rig<double>& rig, wire::OnboardEstimator estimator, const std::string& name);

}  // namespace penduline
