// SPDX-License-Identifier: Apache-2.0
// What the tests of estimators and sessions share: a source in memory, and a sink that keeps all.
#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "host/output/estimate_sink.hpp"
#include "host/source/source.hpp"

namespace penduline::test {

/// Keeps every estimate.
class KeepingSink final : public EstimateSink {
 public:
  tl::expected<void, Error> take(const Estimate<double>& estimate) override {
    estimates.push_back(estimate);
    return {};
  }

  std::vector<Estimate<double>> estimates;
};

/// Hands on given samples, then ends.
class ScriptedSource final : public Source {
 public:
  explicit ScriptedSource(std::vector<Sample> samples) : samples_(std::move(samples)) {}

  [[nodiscard]] RecordingHeader header() const override { return {}; }
  tl::expected<ReadResult, Error> read(Sample& sample) override {
    events_ = std::exchange(events_before[next_], {});
    if (on_read) {
      on_read(next_);
    }
    if (failure_at == next_) {
      return failure(place() + ": the script fails here");
    }
    if (next_ == samples_.size()) {
      return ReadResult::kEnded;
    }
    sample = samples_[next_++];
    return ReadResult::kSample;
  }
  [[nodiscard]] std::string place() const override { return fmt::format("script:{}", next_); }
  [[nodiscard]] double progress() const override { return 0; }
  [[nodiscard]] std::vector<std::string> complaints() const override { return complaints_; }

  [[nodiscard]] std::span<const RecordingEvent> events() const override { return events_; }

  /// What happens before the sample of this place.
  std::map<std::size_t, std::vector<RecordingEvent>> events_before;
  /// Called before each read with the number of samples already handed on.
  std::function<void(std::size_t)> on_read;
  /// After how many samples to fail.
  std::optional<std::size_t> failure_at;
  std::vector<std::string> complaints_;

 private:
  std::vector<Sample> samples_;
  std::vector<RecordingEvent> events_;
  std::size_t next_ = 0;
};

/// A sample of the paper's rig at rest, 20 a second: both gaps 20 mm, so 10 mm / 0.006 m/V.
[[nodiscard]] inline Sample rest_sample(std::uint64_t seq) {
  Sample sample{.seq = seq, .t_us = static_cast<std::int64_t>(seq) * 50'000};
  sample.readings[0] = sample.readings[1] = {.on = 33099, .off = 0};
  return sample;
}

[[nodiscard]] inline std::vector<Sample> rest_samples(std::uint64_t count) {
  std::vector<Sample> samples;
  for (std::uint64_t seq = 0; seq < count; ++seq) {
    samples.push_back(rest_sample(seq));
  }
  return samples;
}

}  // namespace penduline::test
