// SPDX-License-Identifier: Apache-2.0
// Telling boards apart; commands that change what a board samples.
#include "host/source/board_sampling.hpp"

#include <fmt/format.h>

#include "common/wire/commands.hpp"

namespace penduline {

std::string serial_number_of(const wire::Hello& hello) {
  std::string text;
  for (const std::uint8_t byte : hello.unique_id) {
    text += fmt::format("{:02X}", byte);
  }
  return text;
}

tl::expected<void, Error> require_same_board(const std::string& port_name, const wire::Hello& found,
                                             const wire::Hello& expected) {
  if (found.unique_id != expected.unique_id) {
    return failure(fmt::format("{}: found board {}, expected {}", port_name,
                               serial_number_of(found), serial_number_of(expected)));
  }
  if (found.full_scale_counts != expected.full_scale_counts ||
      found.reference_uv != expected.reference_uv || found.sensor_count != expected.sensor_count) {
    return failure(fmt::format(
        "{}: the board now reads {} sensors to {} counts at {} uV, expected {}, {} and {}",
        port_name, found.sensor_count, found.full_scale_counts, found.reference_uv,
        expected.sensor_count, expected.full_scale_counts, expected.reference_uv));
  }
  return {};
}

tl::expected<void, Error> require_done(const std::string& port_name, std::string_view what,
                                       const tl::expected<wire::Result, Error>& result) {
  if (!result) {
    return tl::unexpected(result.error());
  }
  if (*result != wire::Result::kDone) {
    return failure(fmt::format("{}: the board refuses {}: {}", port_name, what,
                               wire::name_of(wire::kResults, *result)));
  }
  return {};
}

tl::expected<void, Error> apply_sampling(const Sampling& wanted, BoardConnection& connection,
                                         wire::Hello& hello) {
  const BytePort& port = connection.port();
  if (!port.two_way()) {
    return {};
  }
  if (hello.rate_millihz != wanted.rate_millihz) {
    if (auto set =
            require_done(port.name(), fmt::format("a rate of {} Hz", wanted.rate_millihz / 1e3),
                         connection.request(wire::SetRate{.rate_millihz = wanted.rate_millihz}));
        !set) {
      return set;
    }
    hello.rate_millihz = wanted.rate_millihz;
  }
  if (hello.emitter_mode != wanted.emitter_mode) {
    const std::string_view mode = wire::name_of(wire::kEmitterModes, wanted.emitter_mode);
    if (auto set = require_done(port.name(), fmt::format("the emitter mode {}", mode),
                                connection.request(wire::SetEmitter{.mode = wanted.emitter_mode}));
        !set) {
      return set;
    }
    hello.emitter_mode = wanted.emitter_mode;
  }
  return {};
}

}  // namespace penduline
