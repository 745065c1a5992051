// SPDX-License-Identifier: Apache-2.0
// Penduline on a Raspberry Pi Pico.
#include "firmware/application.hpp"
#include "firmware/run.hpp"
#include "hal/program.hpp"
#include "hal/rp2040/board.hpp"

namespace penduline {
namespace {

using rp2040::pico;

/// Everything that it needs is in it; nothing is allocated later.
Application<rp2040::Board> application(pico());

}  // namespace

void run_program() {
  pico().start();
  run(application);
}

void on_fault(std::uint32_t pc) {
  restart_after(pico(), [&](CrashRecord& record) { record.note_fault(pc); });
}

void on_failed_assertion(const char* file, std::uint16_t line) {
  restart_after(pico(), [&](CrashRecord& record) { record.note_assertion(file, line); });
}

}  // namespace penduline
