// SPDX-License-Identifier: Apache-2.0
// `penduline doctor`: looks a set-up over and says what to do.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

#include "host/cli/commands.hpp"
#include "host/cli/estimation_options.hpp"
#include "host/cli/log.hpp"
#include "host/doctor/board_checks.hpp"
#include "host/doctor/signal_checks.hpp"
#include "host/doctor/stream_checks.hpp"
#include "host/doctor/survey.hpp"
#include "host/doctor/typed_commands.hpp"
#include "host/session/stop_signal.hpp"
#include "host/source/board_source.hpp"
#include "host/source/port_finder.hpp"
#include "host/source/source_uri.hpp"

namespace penduline {
namespace {

struct DoctorOptions {
  std::string uri = "auto";
  std::string rig_path;
  double seconds = 5;
  bool strict = false;
};

std::string_view word_of(Health health) {
  switch (health) {
    case Health::kGood:
      return "good";
    case Health::kDoubtful:
      return "doubtful";
    case Health::kBad:
      break;
  }
  return "bad";
}

/// Tells findings as they come, and how bad the worst is.
class Report {
 public:
  void tell(const Findings& findings) {
    for (const Finding& finding : findings) {
      fmt::print("{:<9} {}: {}\n", word_of(finding.health), finding.subject, finding.found);
      if (!finding.advice.empty()) {
        fmt::print("          -> {}\n", finding.advice);
      }
      worst_ = std::max(worst_, finding.health);
      ++count_;
      not_good_ += finding.health == Health::kGood ? 0 : 1;
    }
    std::fflush(stdout);
  }

  [[nodiscard]] Health worst() const { return worst_; }

  void finish(bool interrupted) const {
    if (interrupted) {
      fmt::print(
          "interrupted: what is left was not looked at; of {} checks {} want something done\n",
          count_, not_good_);
    } else if (worst_ == Health::kGood) {
      fmt::print("all {} checks are good\n", count_);
    } else {
      fmt::print("{} of {} checks want something done\n", not_good_, count_);
    }
  }

 private:
  Health worst_ = Health::kGood;
  int count_ = 0;
  int not_good_ = 0;
};

tl::expected<std::unique_ptr<Source>, Error> open_source(const SourceUri& uri,
                                                         const StopSignal& stop) {
  if (uri.kind == SourceUri::Kind::kRecording) {
    return open_recording(uri.path);
  }
  return BoardSource::open(port_opener(uri), {.once = true},
                           {.say = [](const std::string& news) { log_info(news); },
                            .stop_requested = [&stop] { return stop.requested(); }});
}

/// What the samples say. Fails where none can be had; a stop is no failure.
tl::expected<void, Error> listen(const DoctorOptions& options, const SourceUri& uri,
                                 const std::optional<RigFile>& rig, const TypedNames& names,
                                 const StopSignal& stop, Report& report) {
  const auto source = open_source(uri, stop);
  if (!source) {
    return stop.requested() ? tl::expected<void, Error>() : tl::unexpected(source.error());
  }
  const auto seen = survey(**source, options.seconds, stop);
  if (!seen) {
    return tl::unexpected(seen.error());
  }
  if (seen->samples > 0 || !stop.requested()) {
    report.tell(check_stream(*seen, names));
    report.tell(check_sensors(*seen, rig, names));
  }
  return {};
}

/// Why a word is no source, without the simulation, which is no set-up; a file's name alone is
/// most likely meant as one.
std::string no_source(const std::string& word, std::string reason) {
  constexpr std::string_view kForms = "auto, serial:PATH, usb:VID:PID or file:PATH";
  std::error_code not_there;
  const std::filesystem::file_status file = std::filesystem::status(word, not_there);
  if (std::filesystem::is_regular_file(file)) {
    return fmt::format("found '{}', expected {}; for that recording: {}", word, kForms,
                       shell_word("file:" + word));
  }
  if (const std::size_t all = reason.find(kSourceForms); all != std::string::npos) {
    reason.replace(all, kSourceForms.size(), kForms);
  }
  return reason;
}

ExitStatus examine(const DoctorOptions& options, const SourceUri& uri) {
  std::optional<RigFile> rig;
  if (!options.rig_path.empty()) {
    auto read = load_rig(options.rig_path);
    if (!read) {
      return log_failure(read.error());
    }
    rig = std::move(*read);
  }
  const bool as_usual = options.seconds == DoctorOptions{}.seconds;
  const TypedNames names{.source = options.uri,
                         .rig = options.rig_path,
                         .recorded = !uri.is_board(),
                         .seconds = as_usual ? std::nullopt : std::optional(options.seconds)};
  const StopSignal stop;
  Report report;
  if (uri.is_board()) {
    report.tell(check_board(uri, names, stop));
  }
  if (report.worst() != Health::kBad && !stop.requested()) {
    if (const auto listened = listen(options, uri, rig, names, stop, report); !listened) {
      return log_failure(listened.error());
    }
  }
  report.finish(stop.requested());
  if (report.worst() == Health::kBad) {
    return ExitStatus::kFailed;
  }
  return options.strict && report.worst() == Health::kDoubtful ? ExitStatus::kDoubtful
                                                               : ExitStatus::kDone;
}

}  // namespace

void add_doctor_command(CLI::App& program, ExitStatus& status) {
  auto options = std::make_shared<DoctorOptions>();
  CLI::App* command =
      program.add_subcommand("doctor", "Look a set-up over and say what to do about it");
  command
      ->add_option("SOURCE", options->uri,
                   "auto, serial:PATH[?baud=N] or usb:VID:PID[:SERIAL] (a board), or file:PATH "
                   "(a recording)")
      ->capture_default_str();
  command->add_option("--rig", options->rig_path, "Rig file: looks at gaps, noise and zero, too")
      ->type_name("FILE");
  command->add_option("--seconds", options->seconds, "How long to listen")
      ->check(CLI::Range(1.0, 3600.0))
      ->type_name("S")
      ->capture_default_str();
  command->add_flag("--strict", options->strict, "End with status 3 where anything is doubtful");
  command->footer(
      "Best with a pendulum that hangs still. Each line says whether what was looked at is good,\n"
      "doubtful (it measures, but could do better) or bad (it does not measure), and what to do.\n"
      "Ends with status 1 where anything is bad.\n\n"
      "  penduline doctor\n"
      "  penduline doctor serial:/dev/ttyACM0 --rig rig.toml");
  command->final_callback([options, &status] {
    const auto uri = parse_uri(options->uri);
    if (!uri) {
      throw CLI::ValidationError("SOURCE", no_source(options->uri, uri.error().message));
    }
    if (uri->kind == SourceUri::Kind::kSimulation) {
      throw CLI::ValidationError("SOURCE", "found sim:, expected a board or a recording");
    }
    status = examine(*options, *uri);
  });
}

}  // namespace penduline
