// SPDX-License-Identifier: Apache-2.0
// Reading and sorting.
#include "host/doctor/survey.hpp"

#include <algorithm>
#include <chrono>

#include "host/saturation.hpp"
#include "host/session/progress_bar.hpp"
#include "host/session/summary.hpp"

namespace penduline {
namespace {

/// Beyond the time that was asked for.
constexpr std::chrono::seconds kPatience{5};

void take(Survey& survey, const Sample& sample) {
  const double volts_per_count =
      survey.acquisition.reference_v / survey.acquisition.full_scale_counts;
  survey.saturated += (sample.flags & flag::kSaturated) != 0 ? 1U : 0U;
  survey.late += (sample.flags & flag::kLate) != 0 ? 1U : 0U;
  for (std::size_t i = 0; i < survey.acquisition.sensor_count; ++i) {
    if (!sample.has_reading(i)) {
      continue;
    }
    SensorSurvey& sensor = survey.sensors[i];
    sensor.ambient_v.push_back(sample.readings[i].off * volts_per_count);
    const auto saturated = is_saturated(sample, survey.acquisition.full_scale_counts, i);
    sensor.saturated += saturated.value_or(false) ? 1U : 0U;
    if (!saturated.value_or(true)) {
      sensor.signal_v.push_back(signal_v(sample.readings[i], survey.acquisition));
    }
  }
}

}  // namespace

tl::expected<Survey, Error> survey(Source& source, double seconds, const StopSignal& stop) {
  Survey result{.acquisition = source.header().acquisition};
  Summary summary(result.acquisition);
  ProgressBar progress(false);
  const auto length_us = static_cast<std::int64_t>(seconds * 1e6);
  std::int64_t passed_us = 0;
  std::int64_t last_us = 0;
  // A board may answer and yet not sample.
  const auto latest =
      std::chrono::steady_clock::now() + kPatience + std::chrono::microseconds(length_us);
  Sample sample;
  while (!stop.requested() && std::chrono::steady_clock::now() < latest) {
    const auto read = source.read(sample);
    if (!read) {
      return tl::unexpected(read.error());
    }
    if (*read == ReadResult::kEnded) {
      break;
    }
    if (*read == ReadResult::kNothingYet) {
      continue;
    }
    // A restart of the board takes its time back.
    passed_us += summary.samples() > 0 ? std::max<std::int64_t>(sample.t_us - last_us, 0) : 0;
    last_us = sample.t_us;
    summary.count(sample);
    take(result, sample);
    if (passed_us >= length_us) {
      break;
    }
    if (progress.due()) {
      progress.draw(static_cast<double>(passed_us) / static_cast<double>(length_us));
    }
  }
  result.samples = summary.samples();
  result.lost = summary.lost();
  result.rate_complaint = summary.rate_complaint().value_or("");
  result.complaints = source.complaints();
  return result;
}

}  // namespace penduline
