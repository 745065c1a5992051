// SPDX-License-Identifier: Apache-2.0
// A session of which everything is kept that a report shows.
#include "host/report/recorded_session.hpp"

#include <fmt/format.h>

#include "host/report/recorded_time.hpp"
#include "host/report/report_notes.hpp"
#include "host/report/report_rows.hpp"
#include "host/report/sensor_totals.hpp"
#include "host/session/session.hpp"

namespace penduline {
namespace {

/// Hands estimates to the report's rows.
class RowsOutput final : public EstimateSink {
 public:
  explicit RowsOutput(ReportRows& rows) : rows_(rows) {}
  tl::expected<void, Error> take(const Estimate<double>& estimate) override {
    rows_.take(estimate);
    return {};
  }

 private:
  ReportRows& rows_;
};

}  // namespace

tl::expected<Extent, Error> extent_of(Source& source, const StopSignal& stop) {
  Extent extent;
  Sample sample;
  std::int64_t last_us = 0;
  while (!stop.requested()) {
    const auto read = source.read(sample);
    if (!read) {
      return tl::unexpected(read.error());
    }
    if (*read == ReadResult::kEnded) {
      break;
    }
    if (extent.samples++ == 0) {
      extent.start_s = 1e-6 * static_cast<double>(sample.t_us);
    } else if (sample.t_us > last_us) {
      extent.seconds += 1e-6 * static_cast<double>(sample.t_us - last_us);
    }
    last_us = sample.t_us;
  }
  return extent;
}

std::string recorded_json(const RecordedSession& recorded, const std::optional<AnalysedSpan>& span,
                          double start_s) {
  const std::string analysed =
      span ? fmt::format(R"({{"from_s":{},"first_swing_to_s":{},"to_s":{}}})",
                         span->from_s - start_s, span->first_swing_to_s - start_s,
                         span->to_s - start_s)
           : "null";
  return fmt::format(R"({{"with_angles":{},"sensors":{},"analysed":{}}})",
                     recorded.state.counts->with_angles(), recorded.sensors, analysed);
}

tl::expected<RecordedSession, Error> read_recorded_session(Source& source,
                                                           const RecordedReading& reading,
                                                           const StopSignal& stop) {
  const Rig<double>& rig = reading.rig.rig;
  const Acquisition<double> acquisition = source.header().acquisition;
  auto estimator = make_estimator(reading.estimator, rig, acquisition);
  if (!estimator) {
    return tl::unexpected(estimator.error());
  }
  RecordedTime time;
  ReportRows rows(rig, acquisition, reading.bin_s);
  RowsOutput output(rows);
  ReportNotes notes;
  SensorTotals sensors(rig, acquisition);
  RecordedSession recorded;
  bool any = false;
  SessionParts parts{
      .source = source, .estimator = **estimator, .output = output, .warn = reading.warn};
  parts.recorder = [&](const Sample& sample) -> tl::expected<void, Error> {
    rows.take(sample, time.follow(sample));
    notes.began(time);
    sensors.take(sample);
    if (!any) {
      recorded.state.began_with_start = (sample.flags & flag::kRestarted) != 0;
    }
    any = true;
    return {};
  };
  parts.note = [&](const RecordingEvent& event) {
    notes.take(event, time);
    time.follow(event);
  };
  const SessionResult result = run_session(parts, {.rows_on_stdout = false}, stop);
  if (result.error) {
    return tl::unexpected(*result.error);
  }
  recorded.rows = rows.finish();
  recorded.breaks = rows.breaks();
  recorded.notes = notes.json();
  recorded.state.counts = result.summary;
  recorded.state.flag_latest_s = rows.flag_latest_s();
  recorded.state.clock = result.clock ? result.clock->text() : "";
  recorded.sensors = sensors.json();
  recorded.doubtful = result.doubtful;
  return recorded;
}

}  // namespace penduline
