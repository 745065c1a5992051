// SPDX-License-Identifier: Apache-2.0
// Flags that stay with every estimate that a sample goes into.
#pragma once

#include <array>
#include <cstddef>

#include "common/fir.hpp"
#include "common/flags.hpp"

namespace penduline {

/// The flags of the last samples, together.
class WindowFlags {
 public:
  WindowFlags() = default;
  /// A window of `samples`, 1..kMaxTaps.
  explicit WindowFlags(std::size_t samples) : samples_(samples) {}

  /// Takes the newest sample's flags and returns all that are set in the window.
  Flags push(Flags newest) {
    flags_[next_] = newest;
    next_ = next_ + 1 == samples_ ? 0 : next_ + 1;
    Flags all = 0;
    for (std::size_t i = 0; i < samples_; ++i) {
      all |= flags_[i];
    }
    return all;
  }

  /// Forgets all flags.
  void clear() { flags_.fill(0); }

 private:
  std::array<Flags, kMaxTaps> flags_{};
  std::size_t samples_ = 1;
  std::size_t next_ = 0;
};

}  // namespace penduline
