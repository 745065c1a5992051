// SPDX-License-Identifier: Apache-2.0
// One turn: news in, events out.
#include "host/web/live_page.hpp"

#include <cmath>
#include <utility>

namespace penduline {
namespace {

constexpr std::size_t kMostNotes = 50;
constexpr std::chrono::seconds kStatePeriod{1};
constexpr std::chrono::seconds kCommentPeriod{5};

double bin_s(const Acquisition<double>& acquisition) {
  return acquisition.rate_hz > LivePage::kMostHz ? LivePage::kBinS : 0;
}

}  // namespace

LivePage::LivePage(LiveFeed& feed, LiveSubject subject, std::function<RecordingState()> recording)
    : feed_(feed),
      subject_(std::move(subject)),
      recording_(std::move(recording)),
      rows_(subject_.rig.rig, {}),
      keeper_(bin_s({}), subject_.rig.rig.layout.count),
      points_(subject_.rig.rig.layout.count) {
  state_.connected = subject_.header.has_value();
  if (const auto header = subject_.header) {
    take_header(*header);
  }
  turn(Clock::now());
}

void LivePage::turn(Clock::time_point now) {
  feed_.collect(news_);
  const std::uint64_t points_before = points_.end();
  if (news_.header) {
    take_header(*news_.header);
  }
  if (news_.counts) {
    state_.counts = news_.counts;
  }
  if (news_.clock) {
    state_.clock = news_.clock->text();
  }
  take_samples();
  tell_session();
  tell_points(points_before);
  take_notes();
  tell_state(now);
  if (now - commented_at_ >= kCommentPeriod) {
    commented_at_ = now;
    events_.add(":\n\n");
  }
}

void LivePage::take_header(const RecordingHeader& header) {
  keeper_.finish(kept_);
  keep_rows();
  subject_.header = header;
  rows_.set_acquisition(header.acquisition);
  const double bin = bin_s(header.acquisition);
  keeper_ = PeakKeeper(bin, subject_.rig.rig.layout.count);
  longest_step_s_ = bin > 0 ? kLongestStep / header.acquisition.rate_hz : kNoEnd;
  state_.connected = true;
  state_changed_ = true;
}

void LivePage::take_samples() {
  for (const LiveSample& live : news_.samples) {
    if (const auto row = rows_.next(live)) {
      take_row(*row);
    }
    note_flags(state_.flag_latest_s, live.estimate.flags,
               rows_.time().at_board_s(live.sample.t_us));
  }
  keep_rows();
  if (!news_.samples.empty()) {
    if (!state_.sample) {
      const Flags first = news_.samples.front().sample.flags;
      state_.began_with_start = (first & flag::kRestarted) != 0;
    }
    state_.sample = news_.samples.back().sample;
  }
}

void LivePage::take_row(const LiveRow& row) {
  // Where rows are thinned, it may be farther from one to the next than over a dropout.
  if (last_s_ && row.t_s - *last_s_ > longest_step_s_) {
    keeper_.add({.t_s = (*last_s_ + row.t_s) / 2}, kept_);
  }
  last_s_ = row.t_s;
  keeper_.add(row, kept_);
}

void LivePage::keep_rows() {
  for (const LiveRow& row : kept_) {
    points_.add(row);
  }
  kept_.clear();
}

void LivePage::take_notes() {
  for (const LiveNote& note : news_.notes) {
    state_.connected = connected_after(note.event, state_.connected);
    notes_.push_back(event_text("note", note_json(note.event, moment_s(note))));
    if (notes_.size() > kMostNotes) {
      notes_.pop_front();
    }
    events_.add(notes_.back());
    state_changed_ = true;
  }
}

double LivePage::moment_s(const LiveNote& note) const {
  constexpr double kFarthest = 1;  // from what the host saw: t_us is of another start's clock
  const auto host_us = note.event.get<std::int64_t>("host_us").value_or(note.host_us);
  const double by_host_s = rows_.time().at_host_s(host_us);
  const auto t_us = note.event.get<std::int64_t>("t_us");
  const double by_board_s = t_us ? rows_.time().at_board_s(*t_us) : by_host_s;
  return std::abs(by_board_s - by_host_s) < kFarthest ? by_board_s : by_host_s;
}

void LivePage::tell_session() {
  const RecordingState recording = recording_();
  recorded_samples_ = recording.samples;
  std::string text = event_text("session", session_json(subject_, recording));
  if (text != session_text_) {
    session_text_ = std::move(text);
    events_.add(session_text_);
    state_changed_ = true;
  }
}

void LivePage::tell_points(std::uint64_t from) {
  if (points_.end() > from) {
    events_.add(event_text("points", points_.json(from)));
  }
}

void LivePage::tell_state(Clock::time_point now) {
  if (!state_changed_ && now - state_told_at_ < kStatePeriod) {
    return;
  }
  state_changed_ = false;
  state_told_at_ = now;
  state_.swing =
      state_.connected ? swing_now(points_.rows(), subject_.rig.rig.pendulum) : std::nullopt;
  state_text_ = event_text("state", state_json(subject_, state_, recorded_samples_));
  events_.add(state_text_);
}

std::string LivePage::greeting() const {
  std::string text = session_text_;
  for (const std::string& slice : points_.slices()) {
    text += event_text("points", slice);
  }
  for (const std::string& note : notes_) {
    text += note;
  }
  return text + state_text_;
}

std::string LivePage::resumption() const {
  return session_text_ + state_text_;
}

}  // namespace penduline
