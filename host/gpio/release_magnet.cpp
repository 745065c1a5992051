// SPDX-License-Identifier: Apache-2.0
// A thread that sleeps until the moment.
#include "host/gpio/release_magnet.hpp"

#include <utility>

#include "host/signals_blocked.hpp"

namespace penduline {

ReleaseMagnet::ReleaseMagnet(std::unique_ptr<GpioOutput> line, Clock::duration delay)
    : line_(std::move(line)), delay_(delay) {}

ReleaseMagnet::~ReleaseMagnet() {
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
  }
  ending_.notify_one();
  if (thread_.joinable()) {
    thread_.join();
  }
}

void ReleaseMagnet::begin(Clock::time_point now) {
  if (!thread_.joinable()) {
    const SignalsBlocked blocked;
    thread_ = std::thread(&ReleaseMagnet::run, this, now + delay_);
  }
}

void ReleaseMagnet::run(Clock::time_point deadline) {
  std::unique_lock lock(mutex_);
  if (ending_.wait_until(lock, deadline, [&] { return ended_; })) {
    return;
  }
  const std::int64_t before_us = host_time_now().monotonic_us;
  const auto released = line_->set(false);
  HostTime moment = host_time_now();
  const std::int64_t half_us = (moment.monotonic_us - before_us) / 2;
  moment.monotonic_us -= half_us;
  moment.utc_us -= half_us;
  release_ = released ? tl::expected<HostTime, Error>(moment) : tl::unexpected(released.error());
}

std::optional<tl::expected<HostTime, Error>> ReleaseMagnet::take_release() {
  const std::lock_guard lock(mutex_);
  return std::exchange(release_, std::nullopt);
}

}  // namespace penduline
