// SPDX-License-Identifier: Apache-2.0
// Continuity of a stream of samples: what is lost, what restarted, what is out of order.
#pragma once

#include <algorithm>
#include <cstdint>

#include "common/flags.hpp"
#include "common/sample.hpp"

namespace penduline {

/// Follows the sequence numbers and times of a stream.
class Continuity {
 public:
  /// Samples in a row may be `longest_step_us` apart (`Acquisition::longest_step_us`).
  explicit Continuity(std::int64_t longest_step_us) : longest_step_us_(longest_step_us) {}

  struct Verdict {
    Flags flags = 0;         ///< kDropout, kOutOfOrder
    std::uint64_t lost = 0;  ///< samples lost before this one, by their numbers
    bool unbroken = true;    ///< follows directly on the sample before
  };

  /// Judges the next sample. The first one follows on nothing and so breaks nothing.
  Verdict follow(const Sample& sample) {
    Verdict verdict;
    if (started_) {
      const bool restarted = (sample.flags & flag::kRestarted) != 0;
      const bool paused =
          sample.seq == last_seq_ + 1 && sample.t_us - last_t_us_ > longest_step_us_;
      if (restarted || paused) {
        verdict = {.flags = flag::kDropout, .unbroken = false};
      } else if (sample.seq <= last_seq_ || sample.t_us <= last_t_us_) {
        verdict = {.flags = flag::kOutOfOrder, .unbroken = false};
        seq_before_stray_ = last_seq_;
      } else if (sample.seq != last_seq_ + 1) {
        // After a stray number the stream may go on where it was before it.
        const std::uint64_t from =
            sample.seq > seq_before_stray_ ? std::max(last_seq_, seq_before_stray_) : last_seq_;
        verdict = {.flags = flag::kDropout, .lost = sample.seq - from - 1, .unbroken = false};
      }
    }
    started_ = true;
    last_seq_ = sample.seq;
    last_t_us_ = sample.t_us;
    return verdict;
  }

 private:
  std::int64_t longest_step_us_;
  bool started_ = false;
  std::uint64_t last_seq_ = 0;
  std::uint64_t seq_before_stray_ = 0;
  std::int64_t last_t_us_ = 0;
};

}  // namespace penduline
