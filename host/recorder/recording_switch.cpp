// SPDX-License-Identifier: Apache-2.0
// Handing a recorder over to the session's thread and back.
#include "host/recorder/recording_switch.hpp"

#include <utility>

#include "hal/linux/host_time.hpp"

namespace penduline {

void RecordingSwitch::join(const RecordingHeader& header) {
  const std::lock_guard lock(mutex_);
  header_ = header;
}

tl::expected<void, Error> RecordingSwitch::start() {
  const std::lock_guard one_change(changing_);
  RecordingHeader header;
  {
    const std::lock_guard lock(mutex_);
    if (recorder_) {
      return failure("A recording is under way already, in " + recorder_->present_name() + ".");
    }
    if (!header_) {
      return failure(kNoSamplesYet);
    }
    header = *header_;
  }
  auto recorder = begin_(header, [this](const std::string& text) { warn(text); });
  if (!recorder) {
    return tl::unexpected(recorder.error());
  }
  const std::lock_guard lock(mutex_);
  // The board may have started anew meanwhile.
  if (header_->boot_id != header.boot_id || header_->acquisition != header.acquisition ||
      header_->serial != header.serial) {
    if (auto followed = (*recorder)->go_on_with(*header_, std::nullopt); !followed) {
      return followed;
    }
  }
  recorder_ = std::move(*recorder);
  state_ = {.last = recorder_->name(), .since_utc_us = host_time_now().utc_us};
  return {};
}

tl::expected<RecorderReport, Error> RecordingSwitch::stop() {
  const std::lock_guard one_change(changing_);
  std::unique_ptr<Recorder> recorder;
  {
    const std::lock_guard lock(mutex_);
    recorder = std::move(recorder_);
  }
  if (!recorder) {
    return failure("No recording is under way.");
  }
  RecorderReport report = recorder->finish();
  const std::lock_guard lock(mutex_);
  state_ = {.last = report.name};
  lost_ += report.lost;
  return report;
}

RecordingSwitch::State RecordingSwitch::state() const {
  const std::lock_guard lock(mutex_);
  State state = state_;
  if (recorder_) {
    state.name = recorder_->present_name();
    state.last = state.name;
  }
  return state;
}

std::uint64_t RecordingSwitch::lost() const {
  const std::lock_guard lock(mutex_);
  return lost_;
}

void RecordingSwitch::tell_warnings_to(Warn warn) {
  const std::lock_guard lock(warning_);
  told_ = std::move(warn);
}

void RecordingSwitch::warn(const std::string& text) {
  const std::lock_guard lock(warning_);
  if (told_) {
    told_(text);
  }
}

tl::expected<void, Error> RecordingSwitch::record(const Sample& sample) {
  const std::lock_guard lock(mutex_);
  if (!recorder_) {
    return {};
  }
  ++state_.samples;
  return recorder_->record(sample);
}

void RecordingSwitch::note(const RecordingEvent& event, const RecordingHeader& now) {
  const std::lock_guard lock(mutex_);
  const bool new_start = event.kind == event::kBoot && header_ && header_->boot_id != now.boot_id;
  if (event.kind == event::kBoot) {
    header_ = now;
  }
  if (recorder_) {
    // A disk that takes no event takes no sample either, and that is told.
    static_cast<void>(new_start ? recorder_->go_on_with(now, event.utc_us)
                                : recorder_->record(event));
  }
}

}  // namespace penduline
