// SPDX-License-Identifier: Apache-2.0
// Counting a session.
#include "host/session/summary.hpp"

#include <fmt/format.h>

#include <cmath>

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
  ++estimates_;
  with_angles_ += estimate.attitude ? 1U : 0U;
  const Flags fresh = estimate.flags & ~seen_;
  seen_ |= estimate.flags;
  flagged_.count(estimate.flags);
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

std::optional<std::string> Summary::noise_complaint() const {
  constexpr std::uint64_t kFewest = 20;
  constexpr std::uint64_t kOneIn = 10;
  const std::uint64_t disturbed = flagged_.of(flag::kDisturbed);
  if (disturbed < kFewest || disturbed * kOneIn <= estimates_) {
    return std::nullopt;
  }
  return fmt::format(
      "{} of {} estimates are disturbed: unless something moves the pendulum, noise_v or noise_m "
      "of "
      "the rig's sensors is too small; 'penduline calibrate rest' measures the noise",
      disturbed, estimates_);
}

std::string Summary::text() const {
  std::string text = fmt::format("{} samples", samples_);
  if (const auto rate = rate_hz()) {
    text += fmt::format(" at {:.3f} Hz", *rate);
  }
  text += fmt::format(", {} lost, {} with angles", lost_, with_angles_);
  if (const std::string flagged = flagged_.text(); !flagged.empty()) {
    text += "; flagged: " + flagged;
  }
  std::string_view separator = "; dropped: ";
  for (const auto& [output, rows] : dropped_) {
    text += fmt::format("{}{} rows by {}", separator, rows, output);
    separator = ", ";
  }
  return text;
}

}  // namespace penduline
