// SPDX-License-Identifier: Apache-2.0
// Notifications by libsystemd.
#include "host/session/service_manager.hpp"

#include <fmt/format.h>
#include <systemd/sd-daemon.h>

#include <algorithm>
#include <cstdint>
#include <utility>

namespace penduline {
namespace {

/// A manager that is gone or does not listen is no reason to fail.
void notify(const std::string& state) {
  static_cast<void>(sd_notify(0, state.c_str()));
}

/// A line of its own, whatever stands in the text.
std::string status_line(std::string text) {
  std::ranges::replace(text, '\n', ' ');
  return "STATUS=" + text;
}

}  // namespace

ServiceManager::ServiceManager() {
  std::uint64_t period_us = 0;
  if (sd_watchdog_enabled(0, &period_us) > 0) {
    watchdog_period_ = std::chrono::microseconds(period_us);
  }
}

ServiceManager::~ServiceManager() {
  stopping();
}

void ServiceManager::ready(const std::string& status) {
  is_up_ = true;
  status_told_at_ = Clock::now();
  notify("READY=1\n" + status_line(status));
}

void ServiceManager::tell(const std::string& status) {
  status_told_at_ = Clock::now();
  notify(status_line(status));
}

void ServiceManager::turned() {
  const auto now = Clock::now();
  if (watchdog_period_ && now - turn_told_at_ >= *watchdog_period_ / 4) {
    turn_told_at_ = now;
    notify("WATCHDOG=1");
  }
}

bool ServiceManager::count_due() const {
  constexpr std::chrono::seconds kCountPeriod{5};
  return Clock::now() - status_told_at_ >= kCountPeriod;
}

void ServiceManager::stopping() {
  if (std::exchange(is_up_, false)) {
    notify("STOPPING=1");
  }
}

}  // namespace penduline
