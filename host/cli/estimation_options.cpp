// SPDX-License-Identifier: Apache-2.0
// From options to a session.
#include "host/cli/estimation_options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <utility>
#include <vector>

#include "hal/replay/recording_format.hpp"
#include "host/cli/log.hpp"
#include "host/output/text_file.hpp"
#include "host/session/session.hpp"
#include "host/web/web_server.hpp"
#include "host/web/web_session.hpp"

namespace penduline {
namespace {

/// Tells what became of a recording. A live run is no worse for it.
void conclude(const RecorderReport& report, bool live, SessionResult& result) {
  log_info(report.text());
  result.doubtful = result.doubtful || report.lost > 0;
  if (!live && report.error && !result.error) {
    result.error = report.error;
  }
}

/// Has the service manager know that the session turns and, as samples come, what it counts.
std::function<void(const Summary&)> reporter(ServiceManager* service) {
  if (service == nullptr) {
    return {};
  }
  return [service, told = std::uint64_t{0}](const Summary& summary) mutable {
    service->turned();
    if (summary.samples() > told && (told == 0 || service->count_due())) {
      told = summary.samples();
      service->tell(summary.text());
    }
  };
}

/// Opens what the estimates go to, each file once in all that the command reads and writes.
tl::expected<std::unique_ptr<Outputs>, Error> open_distinct_outputs(
    const EstimationOptions& options, const EstimationRun& run, const RigFile& rig,
    const RecordingHeader& header, bool watched) {
  std::vector<std::string> paths = output_paths(options.output);
  paths.insert(paths.end(),
               {named_input(run.input_path), named_input(options.rig_path), run.recording.path});
  if (const auto distinct = require_distinct_files(paths); !distinct) {
    return tl::unexpected(distinct.error());
  }
  const EstimatorKind kind = options.estimator.kind;
  // Estimates that come all at once, after the last sample, hold nothing up.
  return open_outputs(options.output, run.live && !is_offline(kind),
                      {.rig = rig,
                       .header = header,
                       .estimator = kind,
                       .has_other_use = !run.recording.path.empty() || watched ||
                                        (run.lines != nullptr && run.lines->holds_any())});
}

/// Begins the recordings that the run was asked for, or that its page asks for.
RecordingSwitch recording_of(const EstimationRun& run) {
  RecordingOptions asked = run.recording;
  asked.path = run.listener ? web_recording_path(run.web, asked) : asked.path;
  return RecordingSwitch([asked, live = run.live, paced = run.paced](
                             const RecordingHeader& now, const RecordingSwitch::Warn& warn) {
    return start_recorder(asked, now, live, live && !paced, warn);
  });
}

tl::expected<SessionResult, Error> run_estimation(const EstimationOptions& options,
                                                  const EstimationRun& run, const RigFile& rig,
                                                  Source& source, RecordingSwitch& recording,
                                                  std::unique_ptr<WebSession> web,
                                                  const StopSignal& stop) {
  const RecordingHeader header = source.header();
  auto estimator = make_estimator(options.estimator, rig.rig, header.acquisition);
  if (!estimator) {
    return tl::unexpected(estimator.error());
  }
  const auto outputs = open_distinct_outputs(options, run, rig, header, web != nullptr);
  if (!outputs) {
    return tl::unexpected(outputs.error());
  }
  SessionParts parts{.source = source,
                     .estimator = **estimator,
                     .output = **outputs,
                     .recorder = {},
                     .note = {},
                     .turned = reporter(run.service),
                     .beside = {},
                     .warn = log_warning};
  if (run.lines != nullptr) {
    parts.beside = [&](const SessionTurn& turn) { return run.lines->turn(turn); };
  }
  recording.join(header);
  if (!run.recording.path.empty()) {
    if (const auto started = recording.start(); !started) {
      return tl::unexpected(started.error());
    }
  }
  if (!run.recording.path.empty() || web) {
    parts.recorder = [&](const Sample& sample) { return recording.record(sample); };
    parts.note = [&](const RecordingEvent& event) { recording.note(event, source.header()); };
  }
  if (web) {
    web->join(parts);
    (*outputs)->add(web->output(), Need::kOptional);
  }
  const bool rows_on_stdout = std::ranges::count(output_paths(options.output), "-") > 0;
  SessionResult result = run_session(
      parts, {.paced = run.paced, .live = run.live, .rows_on_stdout = rows_on_stdout}, stop);
  if (run.service != nullptr) {
    run.service->stopping();
  }
  // What was estimated before a failure is not thrown away.
  const auto finished = (*outputs)->finish([&](const std::string& output, std::uint64_t dropped) {
    result.summary.count_dropped(output, dropped);
  });
  if (!finished && !result.error) {
    result.error = finished.error();
  }
  result.incomplete = (*outputs)->any_failed();
  if (options.output.layout.utc && !result.clock) {
    log_warning("the source says nothing of its clock: the column utc_s is empty");
  }
  result.doubtful = result.doubtful || (run.lines != nullptr && run.lines->edges_lost());
  web.reset();  // so that nobody begins another one
  result.doubtful = result.doubtful || recording.lost() > 0;
  if (const auto report = recording.stop()) {
    conclude(*report, run.live, result);
  }
  return result;
}

}  // namespace

void add_rig_option(CLI::App& command, std::string& path) {
  command
      .add_option(
          "--rig", path,
          "The rig file: geometry, responses, filter (docs/formats.md; examples in docs/rigs)")
      ->required()
      ->type_name("FILE");
}

void add_estimator_options(CLI::App& command, EstimatorOptions& options) {
  const std::map<std::string, EstimatorKind> estimators{{"gn", EstimatorKind::kGaussNewton},
                                                        {"ekf", EstimatorKind::kKalman},
                                                        {"smoother", EstimatorKind::kSmoother},
                                                        {"paper", EstimatorKind::kPaper}};
  command
      .add_option("--estimator", options.kind,
                  "gn: filter, response, Gauss-Newton, row by row;\n"
                  "ekf: Kalman filter on the pendulum's own motion, row by row, without delay;\n"
                  "smoother: the same, corrected by what came later; not for a live run;\n"
                  "paper: the paper's Appendix A to the letter, after the last sample")
      ->transform(CLI::CheckedTransformer(estimators).description(""))
      ->type_name("gn|ekf|smoother|paper")
      ->default_str("gn");
  command.add_flag(
      "--align", options.align,
      "With paper: take the filter's delay out of the rows' times (the others always do)");
  command.parse_complete_callback([&options] {
    if (options.align && options.kind != EstimatorKind::kPaper) {
      throw CLI::ValidationError(
          "--align", "is for --estimator paper; the rows of the others are aligned already");
    }
  });
}

void add_estimation_options(CLI::App& command, EstimationOptions& options) {
  add_rig_option(command, options.rig_path);
  add_estimator_options(command, options.estimator);
  add_output_options(command, options.output);
  command.add_flag("--strict", options.strict,
                   "End with status 3 where the data had flagged problems");
}

tl::expected<RigFile, Error> load_rig(const std::string& path) {
  auto rig = read_rig_file(path);
  if (rig) {
    for (const std::string& complaint : rig->complaints) {
      log_warning(complaint);
    }
  }
  return rig;
}

ExitStatus estimate(const EstimationOptions& options, EstimationRun run, const RigFile& rig,
                    const SourceOpener& open, const StopSignal& stop) {
  RecordingSwitch recording = recording_of(run);
  std::unique_ptr<WebSession> web;
  if (run.listener) {
    web = start_web(run.web, std::move(run.listener),
                    {.rig = rig,
                     .rig_name = std::filesystem::path(options.rig_path).stem().string(),
                     .source = run.source,
                     .estimator = std::string(estimator_name(options.estimator.kind))},
                    run.recording, recording);
  }
  const auto source = open();
  if (!source && stop.requested()) {
    log_info(source.error().message);
    return ExitStatus::kDone;
  }
  if (!source) {
    return log_failure(source.error());
  }
  const auto result = run_estimation(options, run, rig, **source, recording, std::move(web), stop);
  if (!result) {
    return log_failure(result.error());
  }
  if (result->clock) {
    log_info(result->clock->text());
  }
  log_info(result->summary.text());
  if (result->error) {
    return log_failure(*result->error);
  }
  if (result->incomplete) {
    return ExitStatus::kFailed;
  }
  return options.strict && result->doubtful ? ExitStatus::kDoubtful : ExitStatus::kDone;
}

}  // namespace penduline
