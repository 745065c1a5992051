// SPDX-License-Identifier: Apache-2.0
// The loop that every sample goes through on the host.
#include "host/session/session.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdint>

#include "host/session/progress_bar.hpp"

namespace penduline {
namespace {

/// Dates the estimates on their way to the output, counts them and warns of each kind of problem
/// once.
class CountingSink final : public EstimateSink {
 public:
  CountingSink(const SessionParts& parts, SessionResult& result)
      : parts_(parts), summary_(result.summary), clock_(result.clock) {}

  void set_newest(const Sample& sample) { newest_ = sample; }
  /// Says that the board has started anew before the sample to come.
  void note_restart() { restarted_ = summary_.samples() > 0; }

  tl::expected<void, Error> take(const Estimate<double>& estimate) override {
    // The clock is that of the newest sample's start.
    const bool same_start = !restarted_ || estimate.seq == newest_.seq;
    const auto moment = clock_ && same_start ? clock_->host_moment(estimate.t_us) : std::nullopt;
    if (moment) {
      Estimate<double> dated = estimate;
      dated.utc_us = moment->utc_us;
      return take_dated(dated);
    }
    return take_dated(estimate);
  }

  [[nodiscard]] bool output_failed() const { return output_failed_; }

 private:
  tl::expected<void, Error> take_dated(const Estimate<double>& estimate) {
    if (const Flags fresh = summary_.count(estimate) & ~flag::kOrdinary; fresh != 0) {
      warn(fresh, estimate);
    }
    auto taken = parts_.output.take(estimate);
    output_failed_ = !taken;
    return taken;
  }

  void warn(Flags fresh, const Estimate<double>& estimate) const {
    // An offline estimator's rows come when the source is long past them.
    const std::string place =
        estimate.seq == newest_.seq
            ? fmt::format("{}: seq {}, t_us {}", parts_.source.place(), newest_.seq, newest_.t_us)
            : fmt::format("seq {}", estimate.seq);
    for (const FlagDescription& description : kFlagDescriptions) {
      if ((fresh & description.bit) != 0) {
        parts_.warn(fmt::format("{}: {} [{}]; further ones are counted", place, description.meaning,
                                description.name));
        fresh &= ~description.bit;
      }
    }
    if (fresh != 0) {
      parts_.warn(fmt::format("{}: flags {} are not known to this version", place, fresh));
    }
  }

  const SessionParts& parts_;
  Summary& summary_;
  const std::optional<DeviceClock>& clock_;
  Sample newest_;
  bool restarted_ = false;
  bool output_failed_ = false;
};

/// Follows the board's clock by the events of a stream.
void follow(std::optional<DeviceClock>& clock, const RecordingEvent& event) {
  if (event.kind == event::kBoot && clock) {
    clock->reset();
  } else if (const auto exchange = exchange_of(event)) {
    clock = clock ? clock : DeviceClock();
    clock->take(*exchange);
  }
}

/// Has `beside` take its turn, and notes what it tells.
void look_beside(const SessionParts& parts, bool sample, std::span<const RecordingEvent> events,
                 const std::optional<DeviceClock>& clock) {
  if (!parts.beside) {
    return;
  }
  for (const RecordingEvent& event :
       parts.beside({.sample = sample, .events = events, .clock = clock})) {
    if (parts.note) {
      parts.note(event);
    }
  }
}

/// Keeps to the samples' own times.
class Pacer {
 public:
  Pacer(const StopSignal& stop, const std::function<void()>& turned)
      : stop_(stop), turned_(turned) {}

  /// Turns while it waits.
  void wait_for(const Sample& sample) {
    const auto now = std::chrono::steady_clock::now();
    if (!started_ || sample.t_us < last_t_us_) {
      started_ = true;
      origin_ = now - std::chrono::microseconds(sample.t_us);
    }
    last_t_us_ = sample.t_us;
    constexpr std::chrono::milliseconds kLongestSleep{100};
    const auto moment = origin_ + std::chrono::microseconds(sample.t_us);
    while (!stop_.requested() && std::chrono::steady_clock::now() < moment) {
      stop_.sleep_until(std::min(moment, std::chrono::steady_clock::now() + kLongestSleep));
      turned_();
    }
  }

 private:
  const StopSignal& stop_;
  const std::function<void()>& turned_;
  bool started_ = false;
  std::chrono::steady_clock::time_point origin_;  ///< of device time 0
  std::int64_t last_t_us_ = 0;
};

/// Passes the samples on until the source ends, a stop is requested or something fails.
tl::expected<void, Error> pass_samples(const SessionParts& parts, const SessionOptions& options,
                                       const StopSignal& stop, CountingSink& sink,
                                       SessionResult& result) {
  constexpr std::uint64_t kSamplesPerLook = 1024;
  const std::function<void()> turned = [&] {
    if (parts.turned) {
      parts.turned(result.summary);
    }
  };
  Pacer pacer(stop, turned);
  ProgressBar progress(options.rows_on_stdout);
  Sample sample;
  for (std::uint64_t count = 0; !stop.requested();) {
    turned();
    const auto read = parts.source.read(sample);
    for (const RecordingEvent& event : parts.source.events()) {
      follow(result.clock, event);
      if (event.kind == event::kBoot) {
        sink.note_restart();
      }
      if (parts.note) {
        parts.note(event);
      }
    }
    look_beside(parts, read && *read == ReadResult::kSample, parts.source.events(), result.clock);
    if (!read) {
      return tl::unexpected(read.error());
    }
    if (*read == ReadResult::kEnded) {
      break;
    }
    if (*read == ReadResult::kNothingYet) {
      continue;
    }
    if (options.paced) {
      pacer.wait_for(sample);
      if (stop.requested()) {
        break;
      }
    }
    sink.set_newest(sample);
    result.summary.count(sample);
    if (parts.recorder) {
      if (const auto recorded = parts.recorder(sample); !recorded) {
        return tl::unexpected(recorded.error());
      }
    }
    if (const auto taken = parts.estimator.take(sample, sink); !taken) {
      return sink.output_failed()
                 ? tl::unexpected(taken.error())
                 : failure(fmt::format("{}: {}", parts.source.place(), taken.error().message));
    }
    if (!options.live && count++ % kSamplesPerLook == 0 && progress.due()) {
      progress.draw(parts.source.progress());
    }
  }
  return {};
}

}  // namespace

SessionResult run_session(const SessionParts& parts, const SessionOptions& options,
                          const StopSignal& stop) {
  SessionResult result{.summary = Summary(parts.source.header().acquisition)};
  CountingSink sink(parts, result);
  auto outcome = pass_samples(parts, options, stop, sink, result);
  look_beside(parts, false, {}, result.clock);
  const bool ended = outcome && !stop.requested();
  // An offline estimator answers now, also for what came before a failure.
  if (!sink.output_failed()) {
    if (const auto finished = parts.estimator.finish(sink); outcome && !finished) {
      outcome = finished;
    }
  }
  auto complaints = parts.source.complaints();
  if (const auto complaint = result.summary.rate_complaint()) {
    complaints.push_back(*complaint);
  }
  if (const auto complaint = result.summary.noise_complaint()) {
    complaints.push_back(*complaint);
  }
  if (ended && result.summary.samples() == 0) {
    complaints.push_back(parts.source.place() + ": found no sample, expected at least one");
  }
  for (const std::string& complaint : complaints) {
    parts.warn(complaint);
  }
  result.doubtful = result.summary.has_problems() || !complaints.empty();
  if (!outcome) {
    result.error = outcome.error();
  }
  return result;
}

}  // namespace penduline
