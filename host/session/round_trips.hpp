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
  [[nodiscard]] std::int64_t shortest_us() const { return *std::min_element(kept_.begin(), end()); }
  [[nodiscard]] std::int64_t median_us() const {
    auto sorted = kept_;
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(count() / 2);
    std::nth_element(sorted.begin(), middle, sorted.begin() + (end() - kept_.begin()));
    return *middle;
  }

 private:
  static constexpr std::size_t kMost = 256;

  [[nodiscard]] std::array<std::int64_t, kMost>::const_iterator end() const {
    return kept_.begin() + static_cast<std::ptrdiff_t>(count());
  }

  std::array<std::int64_t, kMost> kept_{};
  std::size_t pushed_ = 0;
};

}  // namespace penduline
