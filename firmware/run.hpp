// SPDX-License-Identifier: Apache-2.0
// The main loop.
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

}  // namespace penduline
