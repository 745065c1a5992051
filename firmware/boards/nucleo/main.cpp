// SPDX-License-Identifier: Apache-2.0
// Penduline on an STM32 Nucleo-F446RE.
#include "firmware/application.hpp"
#include "firmware/run.hpp"
#include "hal/program.hpp"
#include "hal/stm32f4/board.hpp"

namespace penduline {
namespace {

using stm32f4::nucleo;

/// Everything that it needs is in it; nothing is allocated later.
Application<stm32f4::Board> application(nucleo());

}  // namespace

void run_program() {
  nucleo().start();
  run(application);
}

void on_fault(std::uint32_t pc) {
  restart_after(nucleo(), [&](CrashRecord& record) { record.note_fault(pc); });
}

void on_failed_assertion(const char* file, std::uint16_t line) {
  restart_after(nucleo(), [&](CrashRecord& record) { record.note_assertion(file, line); });
}

}  // namespace penduline
