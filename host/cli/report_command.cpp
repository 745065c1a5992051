// SPDX-License-Identifier: Apache-2.0
// `penduline report`: a recording in, one page that shows all of it out.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "hal/replay/line_reader.hpp"
#include "host/analysis/analysis_report.hpp"
#include "host/analysis/angle_series.hpp"
#include "host/cli/commands.hpp"
#include "host/cli/estimation_options.hpp"
#include "host/cli/log.hpp"
#include "host/output/text_file.hpp"
#include "host/report/report_page.hpp"
#include "host/report/report_points.hpp"
#include "host/report/report_rows.hpp"
#include "host/session/session.hpp"
#include "host/web/live_json.hpp"

namespace penduline {
namespace {

struct ReportOptions {
  std::string path;
  std::string rig_path;
  EstimatorOptions estimator{.kind = EstimatorKind::kSmoother};
  std::string output_path;
  bool strict = false;
};

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

/// How many samples, and from the first to the last how many seconds of their clock.
struct Extent {
  std::uint64_t samples = 0;
  double seconds = 0;
};

tl::expected<Extent, Error> extent_of(Source& source) {
  Extent extent;
  Sample sample;
  std::int64_t last_us = 0;
  while (true) {
    const auto read = source.read(sample);
    if (!read) {
      return tl::unexpected(read.error());
    }
    if (*read == ReadResult::kEnded) {
      return extent;
    }
    const bool goes_on = extent.samples++ > 0 && sample.t_us > last_us;
    extent.seconds += goes_on ? 1e-6 * static_cast<double>(sample.t_us - last_us) : 0;
    last_us = sample.t_us;
  }
}

/// What the recording's session has come to, as the page shows it.
struct Recorded {
  std::vector<LiveRow> rows;
  std::vector<std::string> notes;
  LiveState state;
  bool doubtful = false;
};

tl::expected<Recorded, Error> read_recording(const ReportOptions& options, const RigFile& rig,
                                             Source& source, double bin_s, const StopSignal& stop) {
  const Acquisition<double> acquisition = source.header().acquisition;
  auto estimator = make_estimator(options.estimator, rig.rig, acquisition);
  if (!estimator) {
    return tl::unexpected(estimator.error());
  }
  ReportRows rows(rig.rig, acquisition, bin_s);
  RowsOutput output(rows);
  Recorded recorded;
  SessionParts parts{
      .source = source, .estimator = **estimator, .output = output, .warn = log_warning};
  parts.recorder = [&](const Sample& sample) -> tl::expected<void, Error> {
    rows.take(sample);
    if (!recorded.state.sample) {
      recorded.state.began_with_start = (sample.flags & flag::kRestarted) != 0;
    }
    recorded.state.sample = sample;
    return {};
  };
  parts.note = [&](const RecordingEvent& event) {
    rows.take(event);
    if (event.kind != event::kPong) {
      recorded.notes.push_back(note_json(event, rows.latest_s()));
    }
  };
  const SessionResult result = run_session(parts, {.rows_on_stdout = false}, stop);
  if (result.error) {
    return tl::unexpected(*result.error);
  }
  recorded.rows = rows.finish();
  recorded.state.counts = result.summary;
  recorded.state.flag_latest_s = rows.flag_latest_s();
  recorded.state.clock = result.clock ? result.clock->text() : "";
  recorded.doubtful = result.doubtful;
  return recorded;
}

/// So many angles a second tell of a pendulum what thousands would, in far less time.
constexpr double kAnalysedHz = 20;

/// Figures of `penduline analyze`, or why there are none.
AnalysisFigures analysis_of(const ReportOptions& options, const RigFile& rig, double rate_hz,
                            LiveState& state) {
  const Pendulum<double>& pendulum = rig.rig.pendulum;
  const auto stride = static_cast<std::size_t>(std::max(1.0, std::floor(rate_hz / kAnalysedHz)));
  const auto series = angles_of_recording(options.path, rig.rig);
  auto analysis = series.and_then([&](const AngleSeries& angles) {
    log_info(fmt::format("analysing {} moments", angles.size() / stride));
    return analyze_swing(angles.thinned(stride),
                         {.gravity_m_s2 = pendulum.gravity_m_s2, .mass_kg = pendulum.mass_kg});
  });
  if (!analysis) {
    return {{"No analysis", analysis.error().message}};
  }
  state.swing = SwingNow{.period_s = analysis->small_period_s.value,
                         .amplitude_rad = analysis->semi_major_rad.value,
                         .ellipse = path_of(analysis->first_swing(), pendulum.length_m)};
  AnalysisFigures figures = analysis_figures(*analysis);
  if (stride > 1) {
    figures.insert(
        figures.begin(),
        {"Analysed", fmt::format("one of {} moments; 'penduline analyze' takes all", stride)});
  }
  return figures;
}

ExitStatus report(const ReportOptions& options) {
  if (const auto file = require_file(options.path); !file) {
    return log_failure(file.error());
  }
  const std::array<std::string, 3> paths{options.path, options.rig_path, options.output_path};
  if (const auto distinct = require_distinct_files(paths); !distinct) {
    return log_failure(distinct.error());
  }
  const auto rig = load_rig(options.rig_path);
  if (!rig) {
    return log_failure(rig.error());
  }
  const auto rig_toml = read_whole_text(options.rig_path);
  if (!rig_toml) {
    return log_failure(rig_toml.error());
  }
  const StopSignal stop;
  const auto extent =
      open_recording(options.path).and_then([](const auto& source) { return extent_of(*source); });
  if (!extent) {
    return log_failure(extent.error());
  }
  const auto source = open_recording(options.path);
  if (!source) {
    return log_failure(source.error());
  }
  const double bin_s = report_bin_s(extent->samples, extent->seconds, rig->rig.layout.count);
  auto recorded = read_recording(options, *rig, **source, bin_s, stop);
  if (stop.requested()) {
    return log_failure({"stopped: no report was written"});
  }
  if (!recorded) {
    return log_failure(recorded.error());
  }
  AnalysisFigures figures =
      analysis_of(options, *rig, (*source)->header().acquisition.rate_hz, recorded->state);
  if (bin_s > 0) {
    figures.insert(figures.begin(),
                   {"Shown", fmt::format("the peaks of every {:.2f} s: {} of {} moments", bin_s,
                                         recorded->rows.size(), extent->samples)});
  }
  const LiveSubject subject{.rig = *rig,
                            .rig_name = std::filesystem::path(options.rig_path).stem().string(),
                            .source = std::filesystem::path(options.path).filename().string(),
                            .estimator = std::string(estimator_name(options.estimator.kind)),
                            .header = (*source)->header()};
  auto file = TextFile::create(options.output_path);
  if (!file) {
    return log_failure(file.error());
  }
  file->text() = report_page({.session = session_json(subject, {}),
                              .state = state_json(subject, recorded->state, extent->samples),
                              .notes = std::move(recorded->notes),
                              .analysis = std::move(figures),
                              .rig_toml = *rig_toml,
                              .points = report_points(recorded->rows, rig->rig.layout.count),
                              .bin_s = bin_s});
  if (const auto written = file->flush(); !written) {
    return log_failure(written.error());
  }
  log_info(recorded->state.counts->text());
  return options.strict && recorded->doubtful ? ExitStatus::kDoubtful : ExitStatus::kDone;
}

}  // namespace

void add_report_command(CLI::App& program, ExitStatus& status) {
  auto options = std::make_shared<ReportOptions>();
  CLI::App* command = program.add_subcommand(
      "report", "One page with all of a recording: plots, figures, rig; opens in any browser");
  command->add_option("RECORDING", options->path, "A recording (docs/formats.md)")->required();
  add_rig_option(*command, options->rig_path);
  add_estimator_options(*command, options->estimator);
  command->get_option("--estimator")->default_str("smoother");
  command
      ->add_option("-o,--output", options->output_path,
                   "The page, an HTML file; - is the standard output")
      ->required()
      ->type_name("FILE");
  command->add_flag("--strict", options->strict,
                    "End with status 3 where the data had flagged problems");
  command->footer(
      "The page needs nothing else: no program, no internet. It shows what the live page shows, "
      "for\n"
      "the whole recording, with zoom; and what 'penduline analyze' finds.\n\n"
      "  penduline report rec.csv --rig rig.toml --output report.html");
  command->final_callback([options, &status] { status = report(*options); });
}

}  // namespace penduline
