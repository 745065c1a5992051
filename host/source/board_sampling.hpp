// SPDX-License-Identifier: Apache-2.0
// Which board a Hello is from, and having it sample as it is asked to.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <tl/expected.hpp>

#include "common/wire/choices.hpp"
#include "common/wire/device_messages.hpp"
#include "hal/linux/board_connection.hpp"

namespace penduline {

/// A board's unique id as USB and recordings write it.
[[nodiscard]] std::string serial_number_of(const wire::Hello& hello);

/// Fails where the Hello that was found is another board's, or of one that converts otherwise.
[[nodiscard]] tl::expected<void, Error> require_same_board(const std::string& port_name,
                                                           const wire::Hello& found,
                                                           const wire::Hello& expected);

/// What came of asking the board on `port_name` for `what`. Fails where it refuses, naming why.
[[nodiscard]] tl::expected<void, Error> require_done(
    const std::string& port_name, std::string_view what,
    const tl::expected<wire::Result, Error>& result);

/// What a host may ask a board for.
struct Sampling {
  std::uint32_t rate_millihz = 0;
  wire::EmitterMode emitter_mode{};
};

/// Has the board sample so, and says it in `hello`. Leaves a port without a way back alone. Fails
/// where the board refuses, naming what it refuses and why, or does not answer.
tl::expected<void, Error> apply_sampling(const Sampling& wanted, BoardConnection& connection,
                                         wire::Hello& hello);

}  // namespace penduline
