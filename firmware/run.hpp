// SPDX-License-Identifier: Apache-2.0
// How a board's program goes on, and how it ends.
#pragma once

#include "firmware/application.hpp"

namespace penduline {

template <FirmwareBoard Board>
[[noreturn]] void run(Application<Board>& application) {
  application.start();
  while (true) {
    application.step();
    application.sleep();
  }
}

/// For a board that cannot go on: `note` writes why into its CrashRecord for the next start.
template <FirmwareBoard Board, class Note>
[[noreturn]] void restart_after(Board& board, const Note& note) {
  note(board.crash_record());
  board.resets().restart();
  __builtin_unreachable();
}

}  // namespace penduline
