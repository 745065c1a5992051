// SPDX-License-Identifier: Apache-2.0
// Logging by spdlog.
#include "host/cli/log.hpp"

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

namespace penduline {

void start_log() {
  spdlog::set_default_logger(spdlog::stderr_color_mt("penduline"));
  spdlog::set_pattern("%^%l%$: %v");
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
