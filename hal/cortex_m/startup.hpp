// SPDX-License-Identifier: Apache-2.0
// The vector table of a Cortex-M and the handlers that every board shares.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

extern "C" {
extern std::uint32_t stack_top;     // NOLINT: from the linker script
[[noreturn]] void start_program();  ///< what a reset begins with
void fault_handler();               ///< tells `on_fault` where the processor was
}

namespace penduline::cortex_m {

using Vector = void (*)();

/// A handler by its exception number: interrupt n is 16 + n.
struct Handler {
  std::size_t exception;
  Vector function;
};

inline constexpr std::size_t kFirstInterrupt = 16;

/// The table's head is the stack, then all handlers by number. To stand in the section `.vectors`.
template <std::size_t Interrupts>
struct VectorTable {
  std::uint32_t* stack;
  std::array<Vector, kFirstInterrupt + Interrupts - 1> vectors;
};

/// A table in which every exception but the reset and those named is a fault.
template <std::size_t Interrupts, std::size_t Count>
[[nodiscard]] constexpr VectorTable<Interrupts> make_vector_table(
    const Handler (&handlers)[Count]) {
  VectorTable<Interrupts> table{&stack_top, {}};
  table.vectors.fill(fault_handler);
  table.vectors[0] = start_program;
  for (const Handler& handler : handlers) {
    table.vectors[handler.exception - 1] = handler.function;
  }
  return table;
}

}  // namespace penduline::cortex_m
