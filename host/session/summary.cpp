// SPDX-License-Identifier: Apache-2.0
// Counting a session.
#include "host/session/summary.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>

namespace penduline {

void Summary::count(const Sample& sample) {
  const Continuity::Verdict verdict = continuity_.follow(sample);
  lost_ += verdict.lost;
  const bool paused = verdict.flags == flag::kDropout && verdict.lost == 0;
  if (samples_ > 0 && (verdict.unbroken || paused)) {
    Steps& steps = paused ? paused_ : unbroken_;
    steps.us += sample.t_us - last_t_us_;
    ++steps.count;
  }
  last_t_us_ = sample.t_us;
  ++samples_;
}

Flags Summary::count(const Estimate<double>& estimate) {
  with_angles_ += estimate.attitude ? 1U : 0U;
  const Flags fresh = estimate.flags & ~seen_;
  seen_ |= estimate.flags;
  if (estimate.flags != 0) {
    for (std::size_t i = 0; i < kFlagDescriptions.size(); ++i) {
      flagged_[i] += (estimate.flags & kFlagDescriptions[i].bit) != 0 ? 1U : 0U;
    }
  }
  return fresh;
}

void Summary::count_dropped(const std::string& output, std::uint64_t rows) {
  dropped_.emplace_back(output, rows);
}

std::optional<double> Summary::rate_hz() const {
  const Steps& most = paused_.count > unbroken_.count ? paused_ : unbroken_;
  if (most.count == 0) {
    return std::nullopt;
  }
  return 1e6 * static_cast<double>(most.count) / static_cast<double>(most.us);
}

std::optional<std::string> Summary::rate_complaint() const {
  constexpr double kTolerance = 0.1;
  const auto rate = rate_hz();
  if (!rate || std::abs(*rate / nominal_hz_ - 1) <= kTolerance) {
    return std::nullopt;
  }
  return fmt::format("the samples come at {:.3f} Hz, expected their nominal {:.3f} Hz", *rate,
                     nominal_hz_);
}

std::string Summary::text() const {
  std::string text = fmt::format("{} samples", samples_);
  if (const auto rate = rate_hz()) {
    text += fmt::format(" at {:.3f} Hz", *rate);
  }
  text += fmt::format(", {} lost, {} with angles", lost_, with_angles_);
  std::string_view separator = "; flagged: ";
  for (std::size_t i = 0; i < kFlagDescriptions.size(); ++i) {
    if (flagged_[i] > 0) {
      text += fmt::format("{}{} {}", separator, flagged_[i], kFlagDescriptions[i].name);
      separator = ", ";
    }
  }
  separator = "; dropped: ";
  for (const auto& [output, rows] : dropped_) {
    text += fmt::format("{}{} rows by {}", separator, rows, output);
    separator = ", ";
  }
  return text;
}

}  // namespace penduline
