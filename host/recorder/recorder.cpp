// SPDX-License-Identifier: Apache-2.0
// The recording thread.
#include "host/recorder/recorder.hpp"

#include <fmt/format.h>

#include <utility>

#include "host/signals_blocked.hpp"

namespace penduline {
namespace {

using Clock = std::chrono::steady_clock;

/// How long entries may wait though nobody waits for them.
constexpr std::chrono::milliseconds kIdleWait{100};

}  // namespace

std::string RecorderReport::text() const {
  std::string text = fmt::format("recorded {} samples in ", samples);
  text += files == 1 ? name : fmt::format("{} files up to {}", files, name);
  return lost == 0 ? text : text + fmt::format(", lost {}", lost);
}

tl::expected<std::unique_ptr<Recorder>, Error> Recorder::start(RecorderSettings settings,
                                                               const RecordingHeader& header) {
  settings.series.durable = settings.sync_period.has_value();
  auto series = RecordingSeries::start(settings.series, header);
  if (!series) {
    return tl::unexpected(series.error());
  }
  const SignalsBlocked in_thread;
  // Not make_unique: the constructor is ours alone.
  return std::unique_ptr<Recorder>(new Recorder(std::move(settings), std::move(*series)));
}

Recorder::Recorder(RecorderSettings settings, RecordingSeries series)
    : settings_(std::move(settings)),
      series_(std::move(series)),
      name_(series_.name()),
      present_name_(name_),
      queue_(settings_.queue_bytes / sizeof(RecordingEntry), settings_.when_full),
      thread_([this] { run(); }) {}

Recorder::~Recorder() {
  finish();
}

tl::expected<void, Error> Recorder::record(const Sample& sample) {
  return queue_.put(sample);
}

tl::expected<void, Error> Recorder::record(RecordingEvent event) {
  return queue_.put(std::move(event));
}

tl::expected<void, Error> Recorder::go_on_with(const RecordingHeader& header,
                                               std::optional<std::int64_t> utc_us) {
  return queue_.put(std::make_unique<BoardReturn>(BoardReturn{header, utc_us}));
}

std::string Recorder::present_name() const {
  const std::lock_guard lock(present_mutex_);
  return present_name_;
}

const RecorderReport& Recorder::finish() {
  if (thread_.joinable()) {
    queue_.close();
    thread_.join();
    report_.name = series_.name();
    report_.files = series_.files();
    report_.samples = added_ - series_.unwritten_samples();
    report_.lost += queue_.lost() + series_.unwritten_samples();
  }
  return report_;
}

void Recorder::run() {
  std::vector<RecordingEntry> entries;
  std::size_t files = series_.files();
  while (queue_.take(entries, sync_due_.value_or(Clock::now() + kIdleWait))) {
    if (!record_all(entries)) {
      return;
    }
    if (std::exchange(files, series_.files()) != series_.files()) {
      const std::lock_guard lock(present_mutex_);
      present_name_ = series_.name();
    }
    // A disk that takes a line now and then is still full.
    if (queue_.empty() && Clock::now() - last_failure_ >= settings_.retry_period) {
      tell_end_of_outage();
    }
    tell_losses();
    sync_if_due();
  }
  tell_end_of_outage();
  if (sync_due_) {
    series_.sync();
  }
}

bool Recorder::record_all(const std::vector<RecordingEntry>& entries) {
  for (std::size_t i = 0; i < entries.size(); ++i) {
    if (!insist([&] { return add(entries[i]); })) {
      for (; i < entries.size(); ++i) {
        report_.lost += std::holds_alternative<Sample>(entries[i]) ? 1U : 0U;
      }
      return false;
    }
    added_ += std::holds_alternative<Sample>(entries[i]) ? 1U : 0U;
  }
  if (!entries.empty() && settings_.sync_period && !sync_due_) {
    sync_due_ = Clock::now() + *settings_.sync_period;
  }
  return insist([&] { return series_.write(); });
}

tl::expected<void, Error> Recorder::add(const RecordingEntry& entry) {
  if (const auto* sample = std::get_if<Sample>(&entry)) {
    return series_.add(*sample);
  }
  if (const auto* event = std::get_if<RecordingEvent>(&entry)) {
    return series_.add(*event);
  }
  const BoardReturn& board = *std::get<std::unique_ptr<const BoardReturn>>(entry);
  return series_.go_on_with(board.header, board.utc_us);
}

template <class Work>
bool Recorder::insist(const Work& work) {
  for (bool last_try = false;;) {
    const tl::expected<void, Error> done = work();
    if (done) {
      return true;
    }
    if (last_try || settings_.when_full == RecordingQueue::WhenFull::kWait) {
      give_up(done.error());
      return false;
    }
    tell_outage(done.error());
    last_try = queue_.wait_for_close(settings_.retry_period);
    tell_losses();
  }
}

void Recorder::give_up(const Error& error) {
  report_.error = error;
  report_.lost += queue_.abandon(error);
}

void Recorder::tell_outage(const Error& error) {
  last_failure_ = Clock::now();
  if (std::exchange(outage_, true)) {
    return;
  }
  lost_before_outage_ = queue_.lost();
  settings_.series.warn(
      fmt::format("{}; sampling goes on, and recording will when it can", error.message));
}

void Recorder::tell_end_of_outage() {
  if (!std::exchange(outage_, false)) {
    return;
  }
  settings_.series.warn(fmt::format("{}: recording goes on; {} samples are missing in it",
                                    series_.name(), queue_.lost() - lost_before_outage_));
}

void Recorder::tell_losses() {
  if (queue_.lost() > 0 && !std::exchange(losses_told_, true)) {
    settings_.series.warn(
        fmt::format("{}: the disk is too slow, and the memory for what waits is full: samples are "
                    "lost to the recording; further ones are counted",
                    series_.name()));
  }
}

void Recorder::sync_if_due() {
  if (sync_due_ && Clock::now() >= *sync_due_) {
    series_.sync();
    sync_due_.reset();
  }
}

}  // namespace penduline
