// SPDX-License-Identifier: Apache-2.0
// Whether the pendulum hangs still: one verdict, on which those about zero and noise rest.
#pragma once

#include <optional>

#include "host/doctor/finding.hpp"
#include "host/doctor/survey.hpp"
#include "host/doctor/typed_commands.hpp"
#include "host/rig_file.hpp"

namespace penduline {

/// Of all sensors together. Motion counts from 0.1 deg on by a rig, which must have as many
/// sensors, else from 0.5 % of a signal; and where it is certainly no noise. Good: it hangs still,
/// and zero and noise can be judged. None where no sensor gives a signal.
[[nodiscard]] std::optional<Finding> check_rest(const Survey& survey,
                                                const std::optional<RigFile>& rig,
                                                const TypedNames& names);

}  // namespace penduline
