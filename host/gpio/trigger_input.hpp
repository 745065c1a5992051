// SPDX-License-Identifier: Apache-2.0
// The trigger input: a thread takes its edges before the kernel's small queue is full.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "hal/linux/gpio.hpp"

namespace penduline {

struct TriggerEdge {
  std::int64_t host_us = 0;         ///< CLOCK_MONOTONIC
  std::int64_t utc_us = 0;          ///< since 1970
  bool others_may_be_lost = false;  ///< behind it, for want of room
};

class TriggerInput {
 public:
  /// What it keeps until somebody takes it: a minute at 1 kHz, an hour at 20 Hz.
  static constexpr std::size_t kMostKept = 65536;

  explicit TriggerInput(std::unique_ptr<GpioInput> line, std::size_t most_kept = kMostKept);
  TriggerInput(const TriggerInput&) = delete;
  TriggerInput& operator=(const TriggerInput&) = delete;
  ~TriggerInput();

  struct Taken {
    std::vector<TriggerEdge> edges{};  ///< since the last call, in their order
    std::optional<Error> error{};      ///< why no more will come, once
  };
  [[nodiscard]] Taken take();

 private:
  void run();
  void keep(const GpioEdges& edges);

  std::unique_ptr<GpioInput> line_;
  const std::size_t most_kept_;
  std::mutex mutex_;
  Taken kept_;
  std::atomic<bool> ended_ = false;
  std::thread thread_;
};

}  // namespace penduline
