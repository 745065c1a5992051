// SPDX-License-Identifier: Apache-2.0
// Hanging the live page onto a session.
#include "host/web/web_session.hpp"

#include <utility>

#include "hal/linux/host_time.hpp"
#include "hal/replay/utc_text.hpp"
#include "host/web/recording_download.hpp"

namespace penduline {
namespace {

class LiveOutput final : public Output {
 public:
  explicit LiveOutput(LiveFeed& feed) : feed_(feed) {}

  tl::expected<void, Error> take(const Estimate<double>& estimate) override {
    feed_.take(estimate);
    return {};
  }
  [[nodiscard]] std::string name() const override { return "the live page"; }
  tl::expected<void, Error> finish() override { return {}; }
  [[nodiscard]] std::uint64_t dropped() const override { return 0; }

 private:
  LiveFeed& feed_;
};

/// What a viewer is not told: it happens every second.
bool is_routine(const RecordingEvent& event) {
  return event.kind == event::kPong;
}

}  // namespace

WebSession::WebSession(std::unique_ptr<WebListener> listener, const WebSettings& settings)
    : recording_(settings.recording),
      may_record_(settings.may_record),
      say_(settings.say),
      page_(feed_, settings.subject, [this] { return recording_state(); }) {
  recording_.tell_warnings_to([this](const std::string& text) { tell("warning", text); });
  server_.emplace(std::move(listener), WebGuard(settings.name, settings.token), page_, actions());
}

WebSession::~WebSession() {
  recording_.tell_warnings_to({});
}

void WebSession::join(SessionParts& parts) {
  feed_.tell(parts.source.header());
  joined_ = true;
  parts.recorder = [this, before = std::move(parts.recorder)](const Sample& sample) {
    feed_.take(sample);
    return before ? before(sample) : tl::expected<void, Error>();
  };
  parts.note = [this, &source = parts.source,
                before = std::move(parts.note)](const RecordingEvent& event) {
    if (event.kind == event::kBoot || event.kind == event::kConnected) {
      feed_.tell(source.header());
    }
    if (!is_routine(event)) {
      feed_.note(event);
    }
    if (before) {
      before(event);
    }
  };
  parts.turned = [this, before = std::move(parts.turned)](const Summary& counts) {
    feed_.tell(counts);
    if (before) {
      before(counts);
    }
  };
  parts.beside = [this, before = std::move(parts.beside)](const SessionTurn& turn) {
    for (const RecordingEvent& event : turn.events) {
      if (event.kind == event::kPong && turn.clock) {
        feed_.tell(*turn.clock);
      }
      connected_ = connected_after(event, connected_);
    }
    std::vector<RecordingEvent> events = before ? before(turn) : std::vector<RecordingEvent>();
    for (RecordingEvent& mark : marks_.take(connected_ ? turn.clock : std::nullopt)) {
      events.push_back(std::move(mark));
    }
    return events;
  };
  parts.warn = [this, before = std::move(parts.warn)](const std::string& text) {
    tell("warning", text);
    before(text);
  };
}

std::unique_ptr<Output> WebSession::output() {
  return std::make_unique<LiveOutput>(feed_);
}

void WebSession::tell(std::string_view kind, std::string text) {
  RecordingEvent event{.kind = std::string(kind), .utc_us = host_time_now().utc_us};
  event.fields.push_back({"text", std::move(text)});
  feed_.note(std::move(event));
}

RecordingState WebSession::recording_state() const {
  const RecordingSwitch::State state = recording_.state();
  RecordingState shown{.can_record = may_record_, .samples = state.samples};
  if (state.name) {
    shown.name = download_name(*state.name);
    shown.since_utc = utc_text_s(state.since_utc_us);
  }
  if (may_record_ && state.last) {
    shown.latest = download_name(*state.last);
  }
  return shown;
}

WebActions WebSession::actions() {
  return {.start_recording = [this] { return start_recording(); },
          .stop_recording = [this] { return stop_recording(); },
          .mark = [this](const std::string& text) { return mark(text); },
          .download = [this] { return may_record_ ? recording_.state().last : std::nullopt; }};
}

tl::expected<void, Error> WebSession::mark(const std::string& text) {
  return joined_ ? marks_.set(text) : failure(kNoSamplesYet);
}

tl::expected<void, Error> WebSession::start_recording() {
  if (!may_record_) {
    return failure("The recording goes to a stream and cannot be started here.");
  }
  if (!joined_) {
    return failure(kNoSamplesYet);
  }
  auto started = recording_.start();
  if (started) {
    tell("recording", "Recording has begun in " + recording_.state().last.value_or("") + ".");
  }
  return started;
}

tl::expected<void, Error> WebSession::stop_recording() {
  if (!may_record_) {
    return failure("The recording goes to a stream and cannot be stopped here.");
  }
  auto report = recording_.stop();
  if (!report) {
    return tl::unexpected(report.error());
  }
  say_(report->text());
  const std::string reason = report->error ? "; " + report->error->message : "";
  tell("recording", "Recording has ended: " + report->text() + reason + ".");
  if (report->error) {
    return tl::unexpected(*report->error);
  }
  return {};
}

}  // namespace penduline
