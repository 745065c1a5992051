// SPDX-License-Identifier: Apache-2.0
// Joining an estimate with the sample of its moment.
#include "host/web/live_rows.hpp"

#include <cstdlib>

#include "common/fir.hpp"

namespace penduline {

std::optional<LiveRow> LiveRows::next(const LiveSample& live) {
  if (time_.follow(live.sample, live.host_us)) {
    samples_.clear();
  }
  samples_.push_back(live.sample);
  if (samples_.size() > kMaxTaps) {
    samples_.pop_front();
  }
  const Estimate<double>& estimate = live.estimate;
  LiveRow row{.t_s = time_.at_board_s(estimate.t_us), .flags = estimate.flags};
  if (last_s_ && row.t_s <= *last_s_) {
    return std::nullopt;
  }
  last_s_ = row.t_s;
  if (estimate.attitude) {
    row.theta1_rad = estimate.attitude->angles.theta1_rad;
    row.theta2_rad = estimate.attitude->angles.theta2_rad;
    row.x_m = estimate.attitude->mass_m.x();
    row.y_m = estimate.attitude->mass_m.y();
    row.z_m = estimate.attitude->mass_m.z();
  }
  if (estimate.sigma_rad) {
    row.sigma1_rad = estimate.sigma_rad->first;
    row.sigma2_rad = estimate.sigma_rad->second;
  }
  put_readings(nearest(estimate.t_us), row);
  return row;
}

const Sample& LiveRows::nearest(std::int64_t t_us) const {
  auto best = samples_.rbegin();
  for (auto each = best; each != samples_.rend(); ++each) {
    if (std::abs(each->t_us - t_us) < std::abs(best->t_us - t_us)) {
      best = each;
    }
  }
  return *best;
}

void LiveRows::put_readings(const Sample& sample, LiveRow& row) const {
  for (std::size_t i = 0; i < rig_.layout.count; ++i) {
    if (sample.has_reading(i)) {
      row.signal_v[i] = signal_v(sample.readings[i], acquisition_);
      row.gap_m[i] = rig_.responses[i].read(row.signal_v[i]).gap_m.value_or(kNotKnown);
    }
  }
}

}  // namespace penduline
