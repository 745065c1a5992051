// SPDX-License-Identifier: Apache-2.0
// Logging by spdlog, from a thread of its own: a terminal that stalls must not hold samples up.
#include "host/cli/log.hpp"

#include <spdlog/async.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <cstddef>

#include "host/signals_blocked.hpp"

namespace penduline {

void start_log() {
  constexpr std::size_t kWaiting = 256;
  const SignalsBlocked blocked;
  spdlog::init_thread_pool(kWaiting, 1);
  spdlog::set_default_logger(
      spdlog::create_async_nb<spdlog::sinks::stderr_color_sink_mt>("penduline"));
  spdlog::set_pattern("%^%l%$: %v");
}

void finish_log() {
  spdlog::shutdown();
}

void log_info(const std::string& text) {
  spdlog::info(text);
}

void log_warning(const std::string& text) {
  spdlog::warn(text);
}

ExitStatus log_failure(const Error& error) {
  spdlog::error(error.message);
  return ExitStatus::kFailed;
}

}  // namespace penduline
