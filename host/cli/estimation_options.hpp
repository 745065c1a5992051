// SPDX-License-Identifier: Apache-2.0
// The options that `replay` and `run` share, and the work behind both.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <memory>
#include <string>
#include <tl/expected.hpp>

#include "host/cli/exit_status.hpp"
#include "host/cli/output_options.hpp"
#include "host/cli/recording_options.hpp"
#include "host/cli/web_options.hpp"
#include "host/estimator/estimator.hpp"
#include "host/gpio/session_lines.hpp"
#include "host/rig_file.hpp"
#include "host/session/service_manager.hpp"
#include "host/session/stop_signal.hpp"
#include "host/source/source.hpp"

namespace penduline {

struct EstimationOptions {
  std::string rig_path;
  EstimatorOptions estimator;
  OutputOptions output;
  bool strict = false;
};

/// How the samples come and what else happens to them.
struct EstimationRun {
  bool live = false;   ///< no sample waits for an output
  bool paced = false;  ///< each sample waits for its time
  RecordingOptions recording{};
  std::string input_path{};           ///< "": the samples come from no file
  ServiceManager* service = nullptr;  ///< told of a live run's turns; none: nobody
  SessionLines* lines = nullptr;      ///< of a board that is there; may be none
  std::string source{};               ///< as typed
  WebOptions web{};
  std::unique_ptr<WebListener> listener{};  ///< of the live page; may be none
};

void add_estimation_options(CLI::App& command, EstimationOptions& options);

/// Adds `--estimator` and what goes with it. A command has one callback after parsing, which is
/// theirs.
void add_estimator_options(CLI::App& command, EstimatorOptions& options);

/// Adds `--rig` to a command that needs one.
void add_rig_option(CLI::App& command, std::string& path);

/// Reads a rig and warns of its unknown keys.
[[nodiscard]] tl::expected<RigFile, Error> load_rig(const std::string& path);

/// Opens the source, which may wait for a board until `stop` is requested.
using SourceOpener = std::function<tl::expected<std::unique_ptr<Source>, Error>()>;

/// Runs a session on a source until it ends or `stop` is requested, and reports it on stderr. The
/// live page is there before the source.
ExitStatus estimate(const EstimationOptions& options, EstimationRun run, const RigFile& rig,
                    const SourceOpener& open, const StopSignal& stop);

}  // namespace penduline
