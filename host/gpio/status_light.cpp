// SPDX-License-Identifier: Apache-2.0
// Switched only where it changes.
#include "host/gpio/status_light.hpp"

#include <utility>

namespace penduline {

StatusLight::StatusLight(std::unique_ptr<GpioOutput> line,
                         std::function<void(const std::string&)> warn)
    : line_(std::move(line)), warn_(std::move(warn)) {}

void StatusLight::turn(bool sample, bool connected, Clock::time_point now) {
  if (!connected) {
    sample_at_.reset();
  } else if (sample) {
    interval_ = now - sample_at_.value_or(now);
    sample_at_ = now;
  }
  set(sample_at_ && now - *sample_at_ < std::chrono::seconds(1) + 2 * interval_);
}

void StatusLight::set(bool lit) {
  if (std::exchange(lit_, lit) == lit) {
    return;
  }
  if (const auto switched = line_->set(lit); !switched && !std::exchange(warned_, true)) {
    warn_(switched.error().message);
  }
}

}  // namespace penduline
