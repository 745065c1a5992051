// SPDX-License-Identifier: Apache-2.0
// The flags of samples and estimates: one list for the code, the files and docs/formats.md.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace penduline {

/// A set of flags; 0 is a sample or an estimate with nothing to say against it.
using Flags = std::uint32_t;

namespace flag {
// Bits 0..7 are set by the device and stand in the recording's `flags` column.
inline constexpr Flags kSaturated = 1U << 0U;
inline constexpr Flags kOverrun = 1U << 1U;
inline constexpr Flags kRestarted = 1U << 2U;
inline constexpr Flags kLate = 1U << 3U;
// Bits 8 and up are set by the pipeline and stand in the estimates only.
inline constexpr Flags kDropout = 1U << 8U;
inline constexpr Flags kOutOfOrder = 1U << 9U;
inline constexpr Flags kMissing = 1U << 10U;
inline constexpr Flags kFilling = 1U << 11U;
inline constexpr Flags kOutOfRange = 1U << 12U;
inline constexpr Flags kFolded = 1U << 13U;
inline constexpr Flags kIllConditioned = 1U << 14U;
inline constexpr Flags kNoSolution = 1U << 15U;
inline constexpr Flags kStray = 1U << 16U;
inline constexpr Flags kDisturbed = 1U << 17U;

/// Flags that are part of a good measurement: a filter fills, a board starts.
inline constexpr Flags kOrdinary = kFilling | kRestarted;
}  // namespace flag

struct FlagDescription {
  Flags bit;
  std::string_view name;
  std::string_view meaning;
};

/// Every flag there is, in the order of its bits.
inline constexpr std::array kFlagDescriptions = {
    FlagDescription{flag::kSaturated, "saturated",
                    "a conversion reached the end of the ADC's range in a sample that went in"},
    FlagDescription{flag::kOverrun, "overrun", "the device lost the windows before this sample"},
    FlagDescription{flag::kRestarted, "restarted", "the first sample after the device started"},
    FlagDescription{flag::kLate, "late",
                    "the device took the sample over an eighth of a period late, or was held up"},
    FlagDescription{flag::kDropout, "dropout",
                    "samples are lost before this one, or sampling paused"},
    FlagDescription{flag::kOutOfOrder, "out_of_order",
                    "seq or t_us went back although the device did not restart"},
    FlagDescription{flag::kMissing, "missing", "the sample lacks a sensor's reading"},
    FlagDescription{flag::kFilling, "filling",
                    "the filter has not yet seen enough samples in a row"},
    FlagDescription{flag::kOutOfRange, "out_of_range",
                    "a gap is outside its response's range, or its beam misses the disc"},
    FlagDescription{flag::kFolded, "folded",
                    "a signal is at its response's peak or beyond, where a nearer disc gives less"},
    FlagDescription{flag::kIllConditioned, "ill_conditioned",
                    "the tilt is near one that the sensors cannot tell from its neighbours"},
    FlagDescription{flag::kNoSolution, "no_solution", "no tilt of the disc gives these gaps"},
    FlagDescription{flag::kStray, "stray", "a gap was too far from what was expected to be used"},
    FlagDescription{flag::kDisturbed, "disturbed",
                    "the pendulum does not swing freely: something pushes, holds or stops it"},
};

}  // namespace penduline
