// SPDX-License-Identifier: Apache-2.0
// The enumerations of the wire, one list each: for the code, the tests and docs/protocol.md.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace penduline::wire {

/// One value of an enumeration. A newer peer may send others: a reader keeps them as they are.
template <class Enum>
struct Choice {
  Enum value;
  std::string_view name;
  std::string_view meaning;
};

/// The name of a value, "unrecognised" where the list does not have it.
template <class Enum, std::size_t kCount>
[[nodiscard]] constexpr std::string_view name_of(const std::array<Choice<Enum>, kCount>& choices,
                                                 Enum value) {
  for (const Choice<Enum>& choice : choices) {
    if (choice.value == value) {
      return choice.name;
    }
  }
  return "unrecognised";
}

enum class EmitterMode : std::uint8_t { kSwitched = 0, kLit = 1, kDark = 2 };

inline constexpr std::array kEmitterModes = {
    Choice<EmitterMode>{EmitterMode::kSwitched, "switched",
                        "lit for one half of the window, dark for the other"},
    Choice<EmitterMode>{EmitterMode::kLit, "lit", "always lit; the dark readings are 0"},
    Choice<EmitterMode>{EmitterMode::kDark, "dark", "never lit: both readings are ambient light"},
};

enum class RebootTarget : std::uint8_t { kApplication = 0, kBootloader = 1 };

inline constexpr std::array kRebootTargets = {
    Choice<RebootTarget>{RebootTarget::kApplication, "application", "start anew"},
    Choice<RebootTarget>{RebootTarget::kBootloader, "bootloader", "wait for new firmware"},
};

enum class ResetCause : std::uint8_t {
  kPowerOn = 0,
  kExternal = 1,
  kWatchdog = 2,
  kSoftware = 3,
  kFault = 4,
  kAssertion = 5,
  kUnknown = 6,
};

inline constexpr std::array kResetCauses = {
    Choice<ResetCause>{ResetCause::kPowerOn, "power_on", "power came on, or dipped"},
    Choice<ResetCause>{ResetCause::kExternal, "external", "the reset pin or a debugger"},
    Choice<ResetCause>{ResetCause::kWatchdog, "watchdog", "the main loop stood still"},
    Choice<ResetCause>{ResetCause::kSoftware, "software", "the command `Reboot`"},
    Choice<ResetCause>{ResetCause::kFault, "fault", "the processor trapped; `fault_pc` says where"},
    Choice<ResetCause>{ResetCause::kAssertion, "assertion",
                       "the firmware broke a promise of its own; `fault_file` says where"},
    Choice<ResetCause>{ResetCause::kUnknown, "unknown", "the chip does not say"},
};

enum class StoreState : std::uint8_t { kEmpty = 0, kValid = 1, kDamaged = 2 };

inline constexpr std::array kStoreStates = {
    Choice<StoreState>{StoreState::kEmpty, "empty", "no rig is stored"},
    Choice<StoreState>{StoreState::kValid, "valid", "the stored rig is in use"},
    Choice<StoreState>{StoreState::kDamaged, "damaged", "something is stored, but not a rig"},
};

enum class OnboardEstimator : std::uint8_t { kGaussNewton = 0, kKalman = 1 };

inline constexpr std::array kOnboardEstimators = {
    Choice<OnboardEstimator>{OnboardEstimator::kGaussNewton, "gn",
                             "filter and Gauss-Newton: angles, late by the filter"},
    Choice<OnboardEstimator>{OnboardEstimator::kKalman, "ekf",
                             "Kalman filter: angles, rates and their uncertainty, up to 100 Hz"},
};

enum class Result : std::uint8_t {
  kDone = 0,
  kUnknownCommand = 1,
  kWrongLength = 2,
  kOutOfRange = 3,
  kNotSupported = 4,
  kBusy = 5,
  kStoreFailed = 6,
  kNoUpload = 7,
  kIncomplete = 8,
  kDamaged = 9,
  kInvalidRig = 10,
};

inline constexpr std::array kResults = {
    Choice<Result>{Result::kDone, "done", "the command was carried out"},
    Choice<Result>{Result::kUnknownCommand, "unknown_command", "newer than the firmware"},
    Choice<Result>{Result::kWrongLength, "wrong_length", "the payload is too short"},
    Choice<Result>{Result::kOutOfRange, "out_of_range", "a number is not allowed; nothing changed"},
    Choice<Result>{Result::kNotSupported, "not_supported", "this board cannot do that"},
    Choice<Result>{Result::kBusy, "busy", "not now; ask again"},
    Choice<Result>{Result::kStoreFailed, "store_failed", "the flash did not take the rig"},
    Choice<Result>{Result::kNoUpload, "no_upload", "`RigPart` or `EndRig` without `BeginRig`"},
    Choice<Result>{Result::kIncomplete, "incomplete", "`EndRig` before all bytes had come"},
    Choice<Result>{Result::kDamaged, "damaged", "the bytes do not have the CRC of `BeginRig`"},
    Choice<Result>{Result::kInvalidRig, "invalid_rig", "the bytes are not a rig that works"},
};

}  // namespace penduline::wire
