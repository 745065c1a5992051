// SPDX-License-Identifier: Apache-2.0
// What the light on the board shows: a short flash each second while it samples, a flicker to be
// found.
#pragma once

#include <cstdint>

namespace penduline {

class Lights {
 public:
  /// Flickers for so long from now on; 0 stops it.
  void identify(std::uint64_t now_us, std::uint8_t seconds) {
    flicker_until_us_ = now_us + std::uint64_t{seconds} * kSecondUs;
  }

  [[nodiscard]] bool lit(std::uint64_t now_us) const {
    constexpr std::uint32_t kFlashUs = 60'000;
    constexpr std::uint32_t kFlickerUs = 100'000;
    const auto in_second_us = static_cast<std::uint32_t>(now_us % kSecondUs);
    return now_us < flicker_until_us_ ? in_second_us / kFlickerUs % 2 == 0
                                      : in_second_us < kFlashUs;
  }

 private:
  static constexpr std::uint32_t kSecondUs = 1'000'000;
  std::uint64_t flicker_until_us_ = 0;
};

}  // namespace penduline
