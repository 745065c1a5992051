// SPDX-License-Identifier: Apache-2.0
// Whether the pendulum hangs still: one verdict, on which those about zero and noise rest.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "host/doctor/finding.hpp"
#include "host/doctor/survey.hpp"
#include "host/doctor/typed_commands.hpp"
#include "host/rig_file.hpp"

namespace penduline {

/// A signal less than this share of the ADC's range is none.
inline constexpr double kNoSignalShare = 0.003;

/// What to do first about noise.
inline constexpr std::string_view kQuietenAdvice =
    "look for loose wires, a lamp that flickers and a noisy supply";

/// What samples can tell of it.
enum class Rest {
  kUnknown,  ///< nothing: too few samples
  kMoving,   ///< neither zero nor noise
  kHidden,   ///< the noise, behind which it may move: no zero
  kStill,    ///< zero and noise
};

struct RestVerdict {
  Rest rest = Rest::kUnknown;
  Finding finding;  ///< good where it hangs still
};

/// A zero farther off is none that drifted: it is another pendulum's rig, or something holds it.
inline constexpr double kGrossZeroDeg = 5;

/// How far a still disc is from where the rig has it, as a sensor sees it, in degrees of a small
/// tilt; none where its mean signal means no gap, or it is on the axis.
[[nodiscard]] std::optional<double> zero_deg(const Survey& survey, std::size_t sensor,
                                             const RigFile& rig);

/// Whether zeroing makes sense: each sensor's mean signal means a gap, and no zero is grossly off.
/// The rig must have as many sensors.
[[nodiscard]] bool can_be_zeroed(const Survey& survey, const RigFile& rig);

/// Of all sensors together. Motion counts from 0.1 deg on by a rig, which must have as many
/// sensors, else from 0.5 % of a signal; and where it is certainly no noise: noise that hides as
/// much is a doubt. None where no sensor gives a signal.
[[nodiscard]] std::optional<RestVerdict> check_rest(const Survey& survey,
                                                    const std::optional<RigFile>& rig,
                                                    const TypedNames& names);

}  // namespace penduline
