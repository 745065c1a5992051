// SPDX-License-Identifier: Apache-2.0
// How often each flag was seen.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

#include "common/flags.hpp"

namespace penduline {

class FlagCounts {
 public:
  void count(Flags flags) {
    if (flags != 0) {
      for (std::size_t i = 0; i < kFlagDescriptions.size(); ++i) {
        counts_[i] += (flags & kFlagDescriptions[i].bit) != 0 ? 1U : 0U;
      }
    }
  }

  /// Of one flag; 0 where this version does not know it.
  [[nodiscard]] std::uint64_t of(Flags bit) const {
    std::uint64_t found = 0;
    for (std::size_t i = 0; i < kFlagDescriptions.size(); ++i) {
      found = kFlagDescriptions[i].bit == bit ? counts_[i] : found;
    }
    return found;
  }

  /// In the order of the bits: "1 saturated, 2 filling"; empty where none was seen.
  [[nodiscard]] std::string text() const {
    std::string text;
    for (std::size_t i = 0; i < kFlagDescriptions.size(); ++i) {
      if (counts_[i] > 0) {
        text += (text.empty() ? "" : ", ") + std::to_string(counts_[i]) + ' ';
        text += kFlagDescriptions[i].name;
      }
    }
    return text;
  }

 private:
  std::array<std::uint64_t, kFlagDescriptions.size()> counts_{};
};

}  // namespace penduline
