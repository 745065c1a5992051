// SPDX-License-Identifier: Apache-2.0
// From the kernel's queue into one that is large enough.
#include "host/gpio/trigger_input.hpp"

#include <chrono>
#include <utility>

#include "hal/linux/host_time.hpp"
#include "host/signals_blocked.hpp"

namespace penduline {

TriggerInput::TriggerInput(std::unique_ptr<GpioInput> line, std::size_t most_kept)
    : line_(std::move(line)), most_kept_(most_kept) {
  const SignalsBlocked blocked;
  thread_ = std::thread(&TriggerInput::run, this);
}

TriggerInput::~TriggerInput() {
  ended_ = true;
  thread_.join();
}

void TriggerInput::run() {
  constexpr std::chrono::milliseconds kLook{100};  // the end waits for it
  while (!ended_) {
    const auto edges = line_->wait(kLook);
    if (!edges) {
      const std::lock_guard lock(mutex_);
      kept_.error = edges.error();
      return;
    }
    if (!edges->host_us.empty()) {
      keep(*edges);
    }
  }
}

void TriggerInput::keep(const GpioEdges& edges) {
  const HostTime now = host_time_now();
  const std::lock_guard lock(mutex_);
  for (const std::int64_t host_us : edges.host_us) {
    if (kept_.edges.size() == most_kept_) {
      kept_.edges.back().others_may_be_lost = true;
      return;
    }
    kept_.edges.push_back(
        {.host_us = host_us, .utc_us = now.utc_us - (now.monotonic_us - host_us)});
  }
  kept_.edges.back().others_may_be_lost |= edges.queue_was_full;
}

TriggerInput::Taken TriggerInput::take() {
  const std::lock_guard lock(mutex_);
  return std::exchange(kept_, {});
}

}  // namespace penduline
