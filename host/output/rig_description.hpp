// SPDX-License-Identifier: Apache-2.0
// A rig in JSON, for who subscribes to its estimates.
#pragma once

#include <string>
#include <string_view>

#include "hal/replay/recording_format.hpp"
#include "host/rig_file.hpp"

namespace penduline {

/// One JSON object (docs/formats.md, MQTT): the program's version, the machine, the board, the
/// estimator and the rig's numbers by the rig file's names.
[[nodiscard]] std::string describe_rig(const RigFile& rig, const RecordingHeader& header,
                                       std::string_view estimator);

}  // namespace penduline
