// SPDX-License-Identifier: Apache-2.0
// Going through a bin once for each curve.
#include "host/web/peak_keeper.hpp"

#include <cmath>
#include <optional>

namespace penduline {

void PeakKeeper::add(const LiveRow& row, std::vector<LiveRow>& kept) {
  constexpr std::size_t kMostRows = 65536;  // of a bin, whatever the rate
  if (bin_s_ <= 0) {
    kept.push_back(row);
    return;
  }
  const auto bin = static_cast<std::int64_t>(std::floor(row.t_s / bin_s_));
  if (bin != bin_ || rows_.size() >= kMostRows) {
    finish(kept);
    bin_ = bin;
  }
  rows_.push_back(row);
}

void PeakKeeper::finish(std::vector<LiveRow>& kept) {
  keep(kept);
  rows_.clear();
}

void PeakKeeper::keep(std::vector<LiveRow>& kept) const {
  std::vector<bool> worth(rows_.size());
  mark_extremes([](const LiveRow& row) { return row.theta1_rad; }, worth);
  mark_extremes([](const LiveRow& row) { return row.theta2_rad; }, worth);
  for (std::size_t i = 0; i < sensors_; ++i) {
    mark_extremes([i](const LiveRow& row) { return row.signal_v[i]; }, worth);
    mark_extremes([i](const LiveRow& row) { return row.gap_m[i]; }, worth);
  }
  Flags seen = 0;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const bool fresh = (rows_[i].flags & ~seen) != 0;
    seen |= rows_[i].flags;
    const bool turns =
        i > 0 && std::isnan(rows_[i].theta1_rad) != std::isnan(rows_[i - 1].theta1_rad);
    if (turns) {
      worth[i - 1] = true;
    }
    worth[i] = worth[i] || fresh || turns;
  }
  bool any = false;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const bool last_hope = i + 1 == rows_.size() && !any;  // a bin without any answer
    if (worth[i] || last_hope) {
      kept.push_back(rows_[i]);
      any = true;
    }
  }
}

template <class Curve>
void PeakKeeper::mark_extremes(const Curve& curve, std::vector<bool>& worth) const {
  std::optional<std::size_t> least;
  std::optional<std::size_t> most;
  std::optional<std::size_t> absent;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const double value = curve(rows_[i]);
    if (std::isnan(value)) {
      absent = absent.value_or(i);
      continue;
    }
    least = !least || value < curve(rows_[*least]) ? i : *least;
    most = !most || value > curve(rows_[*most]) ? i : *most;
  }
  if (least) {
    worth[*least] = true;
    worth[*most] = true;
    if (absent) {
      worth[*absent] = true;
    }
  }
}

}  // namespace penduline
