// SPDX-License-Identifier: Apache-2.0
// Where estimates leave the program: a file, the standard output, the network.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <tl/expected.hpp>

#include "host/output/estimate_sink.hpp"

namespace penduline {

class Output : public EstimateSink {
 public:
  using Clock = std::chrono::steady_clock;

  /// What messages call it.
  [[nodiscard]] virtual std::string name() const = 0;

  /// Says that no more estimates come; what still waits has until `deadline`. Does not wait.
  virtual void close(Clock::time_point /*deadline*/) {}

  /// Waits for the end, after `close` until little more than its deadline. Fails where what was
  /// taken could not be written.
  virtual tl::expected<void, Error> finish() = 0;

  /// How many estimates were taken and did not come through; final after `finish`.
  [[nodiscard]] virtual std::uint64_t dropped() const = 0;
};

}  // namespace penduline
