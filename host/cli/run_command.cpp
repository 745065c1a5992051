// SPDX-License-Identifier: Apache-2.0
// `penduline run`: samples as they come, estimates at once.
#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>

#include "common/wire/commands.hpp"
#include "host/cli/commands.hpp"
#include "host/cli/estimation_options.hpp"
#include "host/cli/line_options.hpp"
#include "host/cli/log.hpp"
#include "host/cli/simulation_options.hpp"
#include "host/rig_image.hpp"
#include "host/session/service_manager.hpp"
#include "host/session/stop_signal.hpp"
#include "host/source/board_source.hpp"
#include "host/source/port_finder.hpp"
#include "host/source/source_uri.hpp"
#include "host/web/web_server.hpp"

namespace penduline {
namespace {

/// How long a board's USB may take to be there again.
constexpr std::chrono::seconds kPatienceAfterReset{5};

struct RunOptions {
  EstimationOptions estimation;
  SimulationOptions simulation;
  std::string uri;
  RecordingOptions recording;
  bool fast = false;
  BoardSettings board;
  std::optional<wire::OnboardEstimator> upload_rig;
  LineOptions lines;
  WebOptions web;
};

tl::expected<std::unique_ptr<Source>, Error> open_source(
    const RunOptions& options, const SourceUri& uri, const Rig<double>& rig, const StopSignal& stop,
    ServiceManager& service, SessionLines* lines) {
  if (uri.kind == SourceUri::Kind::kSimulation) {
    SimulationSettings settings = simulation_settings(options.simulation, rig);
    settings.duration_s = options.simulation.seconds;
    return simulate(rig, settings);
  }
  if (uri.kind == SourceUri::Kind::kRecording) {
    return open_recording(uri.path);
  }
  BoardListener listener{.say =
                             [&](const std::string& news) {
                               log_info(news);
                               service.tell(news);
                             },
                         .stop_requested =
                             [&] {
                               service.turned();  // while there is no session yet that turns
                               return stop.requested();
                             }};
  if (lines != nullptr) {
    listener.attempted = [lines](BoardAttempt attempt) { lines->attempted(attempt); };
  }
  BoardSettings settings = options.board;
  if (options.upload_rig) {
    auto image = rig_image(rig, *options.upload_rig, options.estimation.rig_path);
    if (!image) {
      return tl::unexpected(image.error());
    }
    settings.rig = RigForBoard{.image = std::move(*image),
                               .sensor_count = rig.layout.count,
                               .estimator = *options.upload_rig};
  }
  return BoardSource::open(port_opener(uri), settings, std::move(listener));
}

/// The rate to ask a board for; none where no option says one.
std::optional<std::uint32_t> rate_millihz(const CLI::App& command, double rate_hz) {
  if (command.count("--rate") == 0) {
    return std::nullopt;
  }
  constexpr double kLeastHz = wire::kLeastRateMillihz / 1e3;
  constexpr double kMostHz = wire::kMostRateMillihz / 1e3;
  if (!(rate_hz >= kLeastHz && rate_hz <= kMostHz)) {
    throw CLI::ValidationError("--rate", fmt::format("found {}, expected {} to {} Hz of a board",
                                                     rate_hz, kLeastHz, kMostHz));
  }
  return static_cast<std::uint32_t>(std::lround(rate_hz * 1e3));
}

/// The values of an enumeration of the wire by their names.
template <class Choices>
auto by_name(const Choices& choices) {
  std::map<std::string, decltype(choices.front().value)> values;
  for (const auto& choice : choices) {
    values.emplace(choice.name, choice.value);
  }
  return values;
}

/// Whether the source is a board's bytes that lie in a file.
bool is_stored(const SourceUri& source) {
  std::error_code not_there;
  return source.kind == SourceUri::Kind::kSerial &&
         std::filesystem::is_regular_file(source.path == "-" ? "/dev/stdin" : source.path,
                                          not_there);
}

/// Whether samples come at their own pace.
bool is_live(const RunOptions& options, const SourceUri& source) {
  return !options.fast && !is_stored(source);
}

ExitStatus run(const RunOptions& options, const SourceUri& source) {
  const auto rig = load_rig(options.estimation.rig_path);
  if (!rig) {
    return log_failure(rig.error());
  }
  require_lines(options.lines, rig->lines, options.estimation.rig_path);
  if (const auto known = look_up_hosts(options.estimation.output); !known) {
    return log_failure(known.error());
  }
  auto listener = open_web(options.web);
  if (!listener) {
    return log_failure(listener.error());
  }
  const StopSignal stop;
  std::unique_ptr<SessionLines> lines;
  if (source.is_board() && !is_stored(source)) {
    auto opened = open_lines(options.lines, rig->lines,
                             !options.recording.path.empty() || *listener != nullptr);
    if (!opened) {
      return log_failure(opened.error());
    }
    lines = std::move(*opened);
  }
  ServiceManager service;
  service.ready("opening " + options.uri);
  const auto open = [&] {
    return open_source(options, source, rig->rig, stop, service, lines.get());
  };
  return estimate(options.estimation,
                  {.live = is_live(options, source),
                   .paced = !options.fast && !source.is_board(),
                   .recording = options.recording,
                   .input_path = source.path,
                   .service = &service,
                   .lines = lines.get(),
                   .source = options.uri,
                   .web = options.web,
                   .listener = std::move(*listener)},
                  *rig, open, stop);
}

void add_board_options(CLI::App& command, RunOptions& options) {
  command
      .add_option("--emitter", options.board.emitter_mode,
                  "Of a board: its emitters in turn lit and dark, always lit, or always dark")
      ->transform(CLI::CheckedTransformer(by_name(wire::kEmitterModes)).description(""))
      ->type_name("switched|lit|dark");
  command
      .add_option("--upload-rig", options.upload_rig,
                  "Of a board: store the rig on it first, so that it finds the angles itself, too, "
                  "by this\nestimator (ekf up to 100 Hz); it keeps the rig without power")
      ->transform(CLI::CheckedTransformer(by_name(wire::kOnboardEstimators)).description(""))
      ->type_name("gn|ekf");
  command.add_flag("--once", options.board.once,
                   "Fail where there is no board, or it goes, instead of waiting for it");
}

/// Throws CLI::ValidationError where an option does not suit the source.
void require_suited(const CLI::App& command, const RunOptions& options, const SourceUri& source) {
  if (source.is_board()) {
    refuse_simulation_options(command, "is for the source sim: only", "--rate");
  } else if (source.kind != SourceUri::Kind::kSimulation) {
    refuse_simulation_options(command, "is for the source sim: only");
  }
  for (const char* name : {"--once", "--emitter", "--upload-rig", "--reset", "--release"}) {
    if (command.count(name) > 0 && !source.is_board()) {
      throw CLI::ValidationError(name, "is for a board only");
    }
  }
  if (is_stored(source)) {
    if (options.upload_rig) {
      throw CLI::ValidationError("--upload-rig", "is for a board, not for its bytes in a file");
    }
    refuse_line_options(options.lines, "is for a board, not for its bytes in a file");
  }
  const EstimatorKind estimator = options.estimation.estimator.kind;
  if (!is_live(options, source) || is_offline(estimator)) {
    refuse_network_outputs(options.estimation.output);
  }
  if (options.web.address && is_offline(estimator)) {
    throw CLI::ValidationError("--web", "shows rows as they come: run gn or ekf");
  }
  if (is_live(options, source) && estimator == EstimatorKind::kSmoother) {
    throw CLI::ValidationError(
        "--estimator",
        "smoother looks back from later samples: run ekf with --record, then replay");
  }
}

}  // namespace

void add_run_command(CLI::App& program, ExitStatus& status) {
  auto options = std::make_shared<RunOptions>();
  CLI::App* command = program.add_subcommand("run", "Turn samples into angles as they come");
  command
      ->add_option(
          "SOURCE", options->uri,
          "auto (the board that is plugged in; auto:SERIAL: that one),\n"
          "serial:PATH[?baud=N] (a board's port), usb:VID:PID[:SERIAL] (without its driver),\n"
          "file:PATH (a recording) or sim: (a simulated rig)")
      ->required();
  add_estimation_options(*command, options->estimation);
  add_recording_options(*command, options->recording);
  add_board_options(*command, *options);
  add_line_options(*command, options->lines);
  add_web_options(*command, options->web);
  command->add_flag("--fast", options->fast, "Do not wait for the samples' own times");
  add_simulation_options(*command, options->simulation,
                         "Until when a simulation runs; else endless");
  command->footer(
      "Runs until the source ends or Ctrl-C. Angles go to stdout, the summary to stderr. Sampling\n"
      "waits for no output: one that stalls loses rows, which the summary counts.\n\n"
      "  penduline run sim: --rig rig.toml --case conical\n"
      "  penduline run sim: --rig rig.toml --seconds 60 --fast --record rec.csv -o angles.csv\n"
      "  penduline run serial:/dev/ttyACM0 --rig rig.toml -o udp:localhost:9870 \\\n"
      "    -o mqtt://broker/lab/rig1 -o angles.csv\n"
      "  penduline run auto --rig rig.toml --reset --release 2 --record rec.csv\n"
      "  penduline run auto --rig rig.toml --web 8080\n\n"
      "Of a board, the rig file's [gpio] may name lines of this computer: a light that is lit "
      "while\n"
      "samples come, a trigger whose edges are recorded, and a reset, also for a board that does "
      "not\n"
      "talk any more.");
  command->final_callback([options, command, &status] {
    const auto source = parse_uri(options->uri);
    if (!source) {
      throw CLI::ValidationError("SOURCE", source.error().message);
    }
    require_suited(*command, *options, *source);
    if (source->is_board()) {
      options->board.patience =
          options->lines.reset ? kPatienceAfterReset : std::chrono::seconds(0);
      options->board.rate_millihz = rate_millihz(*command, options->simulation.settings.rate_hz);
    }
    status = run(*options, *source);
  });
}

}  // namespace penduline
