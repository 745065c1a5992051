// SPDX-License-Identifier: Apache-2.0
// How much of the stack was ever used: painted before, looked at after.
#pragma once

#include <cstdint>

extern "C" {
extern std::uint32_t stack_bottom;  // NOLINT: from the linker script
}

namespace penduline::cortex_m {

inline constexpr std::uint32_t kStackPaint = 0xa5a5a5a5;

/// Paints the stack from its bottom up to a little below where it is now.
inline void paint_stack() {
  constexpr std::uint32_t kInUseWords = 32;
  const std::uint32_t* here = nullptr;
  asm("mov %0, sp" : "=r"(here));
  for (volatile std::uint32_t* word = &stack_bottom; word < here - kInUseWords; ++word) {
    *word = kStackPaint;
  }
}

[[nodiscard]] inline std::uint32_t unused_stack_bytes() {
  const volatile std::uint32_t* word = &stack_bottom;
  while (*word == kStackPaint) {
    ++word;
  }
  return static_cast<std::uint32_t>(word - &stack_bottom) * sizeof(std::uint32_t);
}

}  // namespace penduline::cortex_m
