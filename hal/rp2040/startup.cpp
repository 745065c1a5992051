// SPDX-License-Identifier: Apache-2.0
// From reset to the program: memory, vectors, faults (ARMv6-M B1.5; RP2040 data sheet 2.3.2).
#include <algorithm>
#include <array>
#include <cstdint>

#include "hal/program.hpp"
#include "hal/rp2040/interrupts.hpp"
#include "hal/rp2040/stack.hpp"

extern "C" {
// From the linker script.
extern std::uint32_t stack_top;
extern const std::uint32_t data_load;
extern std::uint32_t data_begin;
extern std::uint32_t data_end;
extern std::uint32_t bss_begin;
extern std::uint32_t bss_end;
extern void (*init_array_begin[])();
extern void (*init_array_end[])();

[[noreturn]] void start_program() {
  penduline::rp2040::paint_stack();
  std::copy_n(&data_load, &data_end - &data_begin, &data_begin);
  std::fill(&bss_begin, &bss_end, 0);
  for (auto* initialise = init_array_begin; initialise != init_array_end; ++initialise) {
    (*initialise)();
  }
  penduline::run_program();
}

/// The processor has put its registers on the stack; the seventh word is where it was.
[[noreturn]] void report_fault(const std::uint32_t* frame) {
  penduline::on_fault(frame[6]);
}

[[gnu::naked]] void fault_handler() {
  asm volatile(
      "mrs r0, msp\n"
      "ldr r1, =report_fault\n"
      "bx r1\n");
}

// What is called without ever being needed: destructors of globals, pure virtual calls, abort.
int __aeabi_atexit(void*, void (*)(void*), void*) {
  return 0;
}
void* __dso_handle = nullptr;
[[noreturn]] void abort() {
  penduline::on_fault(reinterpret_cast<std::uintptr_t>(__builtin_return_address(0)));
}
}

namespace penduline::rp2040 {
namespace {

using Vector = void (*)();

constexpr std::size_t kSystemVectors = 16;

/// The stack, then the system's vectors, then the interrupts by number.
constexpr auto make_vectors() {
  std::array<Vector, kSystemVectors + 32 - 1> vectors{};
  vectors.fill(fault_handler);
  vectors[0] = start_program;
  const auto connect = [&](Interrupt interrupt, Vector handler) {
    vectors[kSystemVectors - 1 + static_cast<std::size_t>(interrupt)] = handler;
  };
  connect(Interrupt::kTimer0, on_timer_0);
  connect(Interrupt::kTimer1, on_timer_1);
  connect(Interrupt::kUsb, on_usb);
  connect(Interrupt::kDma0, on_dma_0);
  connect(Interrupt::kUart0, on_uart_0);
  return vectors;
}

struct VectorTable {
  std::uint32_t* stack;
  std::array<Vector, kSystemVectors + 32 - 1> vectors;
};

[[gnu::section(".vectors"), gnu::used]] constinit const VectorTable vector_table{&stack_top,
                                                                                 make_vectors()};

}  // namespace
}  // namespace penduline::rp2040
