// SPDX-License-Identifier: Apache-2.0
// Messages to the person at the terminal, on stderr.
#pragma once

#include <string>

#include "hal/error.hpp"
#include "host/cli/exit_status.hpp"

namespace penduline {

/// Sends all messages to stderr as "warning: TEXT", coloured on a terminal. Logging never waits: of
/// more than 256 messages that nobody reads the oldest are lost. Any
/// thread may log.
void start_log();

/// Waits until all messages are written; none may come after it.
void finish_log();

void log_info(const std::string& text);
void log_warning(const std::string& text);

/// Writes the one line that says why the program failed; returns kFailed.
ExitStatus log_failure(const Error& error);

}  // namespace penduline
