// SPDX-License-Identifier: Apache-2.0
// Messages to the person at the terminal, on stderr.
#pragma once

#include <string>

#include "hal/error.hpp"
#include "host/cli/exit_status.hpp"

namespace penduline {

/// Sends all messages to stderr as "warning: TEXT", coloured on a terminal. Any thread may log.
void start_log();

void log_info(const std::string& text);
void log_warning(const std::string& text);

/// Writes the one line that says why the program failed; returns kFailed.
ExitStatus log_failure(const Error& error);

}  // namespace penduline
