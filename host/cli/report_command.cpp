// SPDX-License-Identifier: Apache-2.0
// `penduline report`: a recording in, one page that shows all of it out.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "hal/replay/line_reader.hpp"
#include "host/analysis/analysis_report.hpp"
#include "host/analysis/angle_series.hpp"
#include "host/cli/commands.hpp"
#include "host/cli/estimation_options.hpp"
#include "host/cli/log.hpp"
#include "host/output/text_file.hpp"
#include "host/report/recorded_session.hpp"
#include "host/report/report_page.hpp"
#include "host/report/report_points.hpp"
#include "host/report/report_rows.hpp"
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

/// A report, and what is said beside it.
struct Page {
  std::string html;
  std::string counts;
  bool doubtful = false;
};

constexpr const char* kStopped = "stopped: no report was written";

/// So many angles a second tell of a pendulum what thousands would, in far less time.
constexpr double kAnalysedHz = 20;

/// Figures of `penduline analyze`, or why there are none; puts the first swing into the page.
AnalysisFigures analyse(const ReportOptions& options, const RigFile& rig,
                        const RecordingHeader& header, const StopSignal& stop, LiveState& state,
                        std::optional<AnalysedSpan>& span) {
  const Pendulum<double>& pendulum = rig.rig.pendulum;
  const auto stopped = [&stop] { return stop.requested(); };
  const auto stride =
      static_cast<std::size_t>(std::max(1.0, std::floor(header.acquisition.rate_hz / kAnalysedHz)));
  const auto series = angles_of_recording(options.path, rig.rig, stopped);
  const auto analysis = series.and_then([&](const AngleSeries& angles) {
    log_info(fmt::format("analysing {} moments", angles.size() / stride));
    return analyze_swing(
        angles.thinned(stride),
        {.gravity_m_s2 = pendulum.gravity_m_s2, .mass_kg = pendulum.mass_kg, .stopped = stopped});
  });
  if (!analysis) {
    return {{"No analysis", analysis.error().message}};
  }
  state.swing = SwingNow{.period_s = analysis->small_period_s.value,
                         .amplitude_rad = analysis->semi_major_rad.value,
                         .ellipse = path_of(analysis->first_swing(), pendulum.length_m)};
  const double from_s = analysis->series.t_s.front();
  span = AnalysedSpan{.from_s = from_s,
                      .first_swing_to_s = from_s + analysis->small_period_s.value,
                      .to_s = analysis->series.t_s.back()};
  AnalysisFigures figures = analysis_figures(*analysis);
  if (stride > 1) {
    figures.insert(
        figures.begin(),
        {"Analysed", fmt::format("one of {} moments; 'penduline analyze' takes all", stride)});
  }
  return figures;
}

/// A recording that was read whole.
struct Reading {
  Extent extent;
  RecordingHeader header;
  double bin_s = 0;
  RecordedSession session;
};

/// Fails as reading does, and where a stop is requested on the way.
tl::expected<Reading, Error> read_whole(const ReportOptions& options, const RigFile& rig,
                                        const StopSignal& stop) {
  Reading reading;
  const auto extent = open_recording(options.path).and_then([&](const auto& source) {
    return extent_of(*source, stop);
  });
  if (stop.requested()) {
    return failure(kStopped);
  }
  if (!extent) {
    return tl::unexpected(extent.error());
  }
  const auto source = open_recording(options.path);
  if (!source) {
    return tl::unexpected(source.error());
  }
  reading.extent = *extent;
  reading.bin_s = report_bin_s(extent->samples, extent->seconds, rig.rig.layout.count);
  auto session = read_recorded_session(
      **source,
      {.rig = rig, .estimator = options.estimator, .bin_s = reading.bin_s, .warn = log_warning},
      stop);
  if (stop.requested()) {
    return failure(kStopped);
  }
  if (!session) {
    return tl::unexpected(session.error());
  }
  reading.session = std::move(*session);
  reading.header = (*source)->header();
  return reading;
}

/// Fails as reading does, and where a stop is requested on the way.
tl::expected<Page, Error> make_page(const ReportOptions& options, const RigFile& rig,
                                    const StopSignal& stop) {
  const auto rig_toml = read_whole_text(options.rig_path);
  if (!rig_toml) {
    return tl::unexpected(rig_toml.error());
  }
  auto reading = read_whole(options, rig, stop);
  if (!reading) {
    return tl::unexpected(reading.error());
  }
  RecordedSession& session = reading->session;
  std::optional<AnalysedSpan> span;
  AnalysisFigures figures = analyse(options, rig, reading->header, stop, session.state, span);
  if (stop.requested()) {
    return failure(kStopped);
  }
  const std::uint64_t samples = reading->extent.samples;
  if (reading->bin_s > 0) {
    figures.insert(
        figures.begin(),
        {"Shown", fmt::format("the peaks of every {:.2f} s: {} of {} moments", reading->bin_s,
                              session.rows.size() - session.breaks, samples)});
  }
  const LiveSubject subject{.rig = rig,
                            .rig_name = std::filesystem::path(options.rig_path).stem().string(),
                            .source = std::filesystem::path(options.path).filename().string(),
                            .estimator = std::string(estimator_name(options.estimator.kind)),
                            .header = reading->header};
  return Page{
      .html = report_page({.session = session_json(subject, {}),
                           .state = state_json(subject, session.state, samples),
                           .recorded = recorded_json(session, span, reading->extent.start_s),
                           .notes = std::move(session.notes),
                           .analysis = std::move(figures),
                           .rig_toml = *rig_toml,
                           .points = report_points(session.rows, rig.rig.layout.count),
                           .bin_s = reading->bin_s}),
      .counts = session.state.counts->text(),
      .doubtful = session.doubtful};
}

ExitStatus report(const ReportOptions& options) {
  if (const auto file = require_file(options.path); !file) {
    return log_failure(file.error());
  }
  const std::array<std::string, 3> paths{options.path, options.rig_path, options.output_path};
  if (const auto distinct = require_distinct_files(paths); !distinct) {
    return log_failure(distinct.error());
  }
  if (const auto folder = require_folder(options.output_path); !folder) {
    return log_failure(folder.error());
  }
  const auto rig = load_rig(options.rig_path);
  if (!rig) {
    return log_failure(rig.error());
  }
  // Lives on while the page is written: that is not left half done.
  const StopSignal stop;
  auto page = make_page(options, *rig, stop);
  if (!page) {
    return log_failure(page.error());
  }
  auto file = TextFile::create(options.output_path);
  if (!file) {
    return log_failure(file.error());
  }
  file->text() = std::move(page->html);
  if (const auto written = file->flush(); !written) {
    return log_failure(written.error());
  }
  log_info(page->counts);
  return options.strict && page->doubtful ? ExitStatus::kDoubtful : ExitStatus::kDone;
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
