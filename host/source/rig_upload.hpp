// SPDX-License-Identifier: Apache-2.0
// Storing a rig on a board, which finds the angles itself from then on.
#pragma once

#include <cstddef>
#include <cstdint>
#include <tl/expected.hpp>
#include <vector>

#include "common/wire/choices.hpp"
#include "hal/linux/board_connection.hpp"

namespace penduline {

/// A rig on its way to a board.
struct RigForBoard {
  std::vector<std::uint8_t> image;  ///< as `rig_image` makes it
  std::size_t sensor_count = 0;     ///< of the rig
  wire::OnboardEstimator estimator{};
};

/// Sends the rig and has the board store it, in place of one that it has. Windows may be lost
/// meanwhile. Fails where there is no way back to the board, where it has other sensors, refuses
/// the rig or does not answer.
tl::expected<void, Error> upload_rig(const RigForBoard& upload, BoardConnection& connection);

}  // namespace penduline
