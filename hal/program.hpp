// SPDX-License-Identifier: Apache-2.0
// What a board calls of the program above it.
#pragma once

#include <cstdint>

namespace penduline {

/// Called once the memory is as the program expects it.
[[noreturn]] void run_program();

/// Called by the board's fault handler with the place; 0 where it is unknown.
[[noreturn]] void on_fault(std::uint32_t pc);

/// Called where the program's own promise is broken, or the hardware's at start-up.
[[noreturn]] void on_failed_assertion(const char* file, std::uint16_t line);

/// Goes on only where the condition holds.
#define PENDULINE_REQUIRE(condition) \
  ((condition) ? static_cast<void>(0) : ::penduline::on_failed_assertion(__FILE__, __LINE__))

}  // namespace penduline
