// SPDX-License-Identifier: Apache-2.0
// Where a board's port is now: it may come back under another name.
#pragma once

#include "host/source/board_source.hpp"
#include "host/source/source_uri.hpp"

namespace penduline {

/// Opens the port that the URI, which is a board's, stands for. Once a USB device's port has been
/// opened, the same device is looked for again by its serial number.
[[nodiscard]] PortOpener port_opener(const SourceUri& uri);

}  // namespace penduline
