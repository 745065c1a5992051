// SPDX-License-Identifier: Apache-2.0
// A rig's image, piece by piece.
#include "host/source/rig_upload.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "common/wire/commands.hpp"
#include "common/wire/crc32.hpp"
#include "host/source/board_sampling.hpp"

namespace penduline {

tl::expected<void, Error> upload_rig(const RigForBoard& upload, BoardConnection& connection) {
  const std::string& port = connection.port().name();
  if (!connection.port().two_way()) {
    return failure(
        fmt::format("{}: found no way to the board, expected one to upload a rig by", port));
  }
  if (upload.sensor_count != connection.hello().sensor_count) {
    return failure(
        fmt::format("{}: found a rig of {} sensors to upload, expected {}, as many as "
                    "the board reads",
                    port, upload.sensor_count, connection.hello().sensor_count));
  }
  constexpr std::string_view kWhat = "the rig";
  const std::span<const std::uint8_t> image(upload.image);
  auto done = require_done(
      port, kWhat,
      connection.request(wire::BeginRig{.size_bytes = static_cast<std::uint16_t>(image.size()),
                                        .crc = wire::crc32(image)}));
  for (std::size_t at = 0; done && at < image.size(); at += wire::kRigPartBytes) {
    const auto piece = image.subspan(at, std::min(wire::kRigPartBytes, image.size() - at));
    wire::RigPart part{.offset = static_cast<std::uint16_t>(at),
                       .count = static_cast<std::uint8_t>(piece.size())};
    std::ranges::copy(piece, part.bytes.begin());
    done = require_done(port, kWhat, connection.request(part));
  }
  return done ? require_done(port, kWhat, connection.request(wire::EndRig{})) : done;
}

}  // namespace penduline
