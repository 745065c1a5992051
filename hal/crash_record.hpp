// SPDX-License-Identifier: Apache-2.0
// What a start tells the next one of its end, in memory that a reset leaves as it is.
#pragma once

#include <cstdint>
#include <string_view>

#include "common/wire/choices.hpp"
#include "common/wire/text.hpp"

namespace penduline {

/// Stands in memory that is not initialised: after power-on anything may be in it.
struct CrashRecord {
  static constexpr std::uint32_t kValid = 0x5eed1e55;

  std::uint32_t valid;
  std::uint16_t resets;         ///< starts since power came on, the first not counted
  wire::ResetCause told_cause;  ///< what the start before said of its end; kUnknown: nothing
  std::uint32_t fault_pc;       ///< of the last fault; 0 none
  std::uint16_t fault_line;     ///< of the last failed assertion; 0 none
  wire::Text fault_file;
  std::uint32_t boot_id;

  /// To be called once at the start: begins a new record after power-on, else counts a reset.
  void begin(bool after_power_on) {
    if (valid != kValid || after_power_on) {
      const std::uint32_t whatever_was_there = boot_id;
      *this = CrashRecord{};
      valid = kValid;
      told_cause = wire::ResetCause::kUnknown;
      boot_id = whatever_was_there;
    } else {
      ++resets;
    }
    boot_id = boot_id * 1'664'525U + 1'013'904'223U;
  }

  void note_fault(std::uint32_t pc) {
    told_cause = wire::ResetCause::kFault;
    fault_pc = pc;
  }
  void note_assertion(std::string_view file, std::uint16_t line) {
    const std::size_t slash = file.rfind('/');
    told_cause = wire::ResetCause::kAssertion;
    fault_file = wire::text_of(slash == std::string_view::npos ? file : file.substr(slash + 1));
    fault_line = line;
  }
};

}  // namespace penduline
