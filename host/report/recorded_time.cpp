// SPDX-License-Identifier: Apache-2.0
// Events tell the host's time, samples go on from there.
#include "host/report/recorded_time.hpp"

namespace penduline {

std::int64_t RecordedTime::follow(const Sample& sample) {
  if ((sample.flags & flag::kRestarted) != 0 && !starts_) {
    event_t_us_ = sample.t_us;  // no event told of this start
  }
  const std::int64_t since_event_us = event_t_us_ ? sample.t_us - *event_t_us_ : 0;
  event_t_us_ = event_t_us_.value_or(sample.t_us);
  const std::int64_t host_us = event_host_us_.value_or(0) + since_event_us;
  time_.follow(sample, host_us);
  latest_t_us_ = sample.t_us;
  starts_ = false;
  return host_us;
}

void RecordedTime::follow(const RecordingEvent& event) {
  starts_ = starts_ || event.kind == event::kBoot;
  if (event.utc_us) {
    event_host_us_ = *event.utc_us;
    const auto t_us = event.get<std::int64_t>("t_us");
    event_t_us_ = t_us || starts_ ? t_us : latest_t_us_;
  }
}

std::optional<double> RecordedTime::moment_s(const RecordingEvent& event) const {
  if (const auto t_us = event.get<std::int64_t>("t_us")) {
    return starts_ ? std::nullopt : std::optional(time_.at_board_s(*t_us));
  }
  return event.utc_us && event_host_us_ && latest_t_us_ ? time_.at_host_s(*event.utc_us)
                                                        : latest_s();
}

}  // namespace penduline
