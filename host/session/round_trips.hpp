// SPDX-License-Identifier: Apache-2.0
// The latest round trips: how long the shortest took, and a usual one.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace penduline {

/// Keeps the latest 256 round trips, so that a shortest one from another cable or hub ages away.
class RoundTrips {
 public:
  void push(std::int64_t round_trip_us) {
    kept_[pushed_ % kMost] = round_trip_us;
    ++pushed_;
  }

  [[nodiscard]] std::size_t count() const { return std::min(pushed_, kMost); }
  /// Both need one to be kept.
  [[nodiscard]] std::int64_t shortest_us() const {
    return *std::min_element(kept_.begin(), kept_.begin() + static_cast<std::ptrdiff_t>(count()));
  }
  [[nodiscard]] std::int64_t median_us() const {
    auto sorted = kept_;
    const std::size_t middle = count() / 2;
    std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(middle),
                     sorted.begin() + static_cast<std::ptrdiff_t>(count()));
    return sorted[middle];
  }

 private:
  static constexpr std::size_t kMost = 256;

  std::array<std::int64_t, kMost> kept_{};
  std::size_t pushed_ = 0;
};

}  // namespace penduline
