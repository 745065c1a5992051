// SPDX-License-Identifier: Apache-2.0
// From reset to the program, and faults, on any Cortex-M (ARMv6-M and ARMv7-M B1.5).
#include "hal/cortex_m/startup.hpp"

#include <algorithm>
#include <cstdint>

#include "hal/cortex_m/stack.hpp"
#include "hal/program.hpp"

extern "C" {
// From the linker script.
extern const std::uint32_t data_load;
extern std::uint32_t data_begin;
extern std::uint32_t data_end;
extern std::uint32_t bss_begin;
extern std::uint32_t bss_end;
extern void (*init_array_begin[])();
extern void (*init_array_end[])();

[[noreturn]] void start_program() {
#ifdef __ARM_FP
  // Full access to the floating-point unit, before the first use of it (ARMv7-M B3.2.20).
  constexpr std::uint32_t kCoprocessorAccess = 0xe000ed88;
  auto& access = *reinterpret_cast<volatile std::uint32_t*>(kCoprocessorAccess);  // NOLINT
  access = access | (0xfU << 20U);
  asm volatile("dsb\nisb" ::: "memory");
#endif
  penduline::cortex_m::paint_stack();
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
