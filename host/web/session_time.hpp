// SPDX-License-Identifier: Apache-2.0
// One time for a whole session: the board's clock since its first sample, also after restarts.
#pragma once

#include <algorithm>
#include <cstdint>

#include "common/sample.hpp"

namespace penduline {

/// Where the board starts anew its clock begins at 0 again; then the host's clock says how long
/// that took, and the session's time goes on.
class SessionTime {
 public:
  /// Takes the next sample, which came at the host's `host_us`. True where it begins a new start of
  /// the board, to which no earlier device time belongs.
  bool follow(const Sample& sample, std::int64_t host_us) {
    const bool restarted = begun_ && (sample.flags & flag::kRestarted) != 0;
    if (!begun_) {
      zero_us_ = sample.t_us;
    } else if (restarted) {
      zero_us_ = sample.t_us - at_host(host_us);
    }
    begun_ = true;
    last_us_ = sample.t_us - zero_us_;
    last_host_us_ = host_us;
    return restarted;
  }

  /// The session's time at the board's, in seconds.
  [[nodiscard]] double at_board_s(std::int64_t t_us) const {
    return static_cast<double>(t_us - zero_us_) / 1e6;
  }
  /// The session's time at the host's `host_us`, in seconds, as the last sample came.
  [[nodiscard]] double at_host_s(std::int64_t host_us) const {
    return begun_ ? static_cast<double>(at_host(host_us)) / 1e6 : 0;
  }

 private:
  [[nodiscard]] std::int64_t at_host(std::int64_t host_us) const {
    return last_us_ + std::max<std::int64_t>(host_us - last_host_us_, 0);
  }

  bool begun_ = false;
  std::int64_t zero_us_ = 0;  ///< board's time at which the session's is 0
  std::int64_t last_us_ = 0;  ///< session's time of the last sample
  std::int64_t last_host_us_ = 0;
};

}  // namespace penduline
