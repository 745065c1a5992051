// SPDX-License-Identifier: Apache-2.0
// Samples wait for their estimates.
#include "host/report/report_rows.hpp"

#include <cstdlib>
#include <utility>

namespace penduline {

void ReportRows::take(const Sample& sample, std::int64_t host_us) {
  waiting_.push_back({.sample = sample, .host_us = host_us});
}

void ReportRows::take(const Estimate<double>& estimate) {
  const auto off_us = [&](const Waiting& one) { return std::abs(one.sample.t_us - estimate.t_us); };
  if ((estimate.flags & flag::kRestarted) != 0) {
    while (waiting_.size() > 1 && (waiting_.front().sample.flags & flag::kRestarted) == 0) {
      waiting_.pop_front();
    }
  }
  while (waiting_.size() > 1 && (waiting_[1].sample.flags & flag::kRestarted) == 0 &&
         off_us(waiting_[1]) <= off_us(waiting_[0])) {
    waiting_.pop_front();
  }
  if (waiting_.empty()) {
    return;
  }
  const Waiting& nearest = waiting_.front();
  const auto row =
      rows_.next({.sample = nearest.sample, .estimate = estimate, .host_us = nearest.host_us});
  if (!row) {
    return;
  }
  if (last_s_ && row->t_s - *last_s_ > longest_step_s_) {
    keeper_.add({.t_s = (*last_s_ + row->t_s) / 2}, kept_);
    ++breaks_;
  }
  last_s_ = row->t_s;
  keeper_.add(*row, kept_);
  note_flags(flag_latest_s_, row->flags, row->t_s);
}

std::vector<LiveRow> ReportRows::finish() {
  keeper_.finish(kept_);
  return std::exchange(kept_, {});
}

double report_bin_s(std::uint64_t samples, double seconds, std::size_t sensors) {
  if (samples <= ReportRows::kMostRows) {
    return 0;
  }
  // Of each bin the lowest and the highest row of both angles, every signal and every gap.
  const auto most_of_bin = static_cast<double>(2 * (2 + 2 * sensors));
  return seconds * most_of_bin / static_cast<double>(ReportRows::kMostRows);
}

}  // namespace penduline
