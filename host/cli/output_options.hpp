// SPDX-License-Identifier: Apache-2.0
// The options that say where estimates go, and opening what they name.
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <tl/expected.hpp>
#include <vector>

#include "hal/replay/recording_format.hpp"
#include "host/estimator/estimator.hpp"
#include "host/output/estimate_writer.hpp"
#include "host/output/outputs.hpp"
#include "host/rig_file.hpp"

namespace penduline {

struct OutputOptions {
  std::vector<std::string> addresses;  ///< none: the standard output
  EstimateLayout layout;
  int mqtt_qos = 0;
  std::string mqtt_password_file;  ///< "": none
};

void add_output_options(CLI::App& command, OutputOptions& options);

/// The paths among the addresses.
[[nodiscard]] std::vector<std::string> output_paths(const OutputOptions& options);

/// Refuses, as wrong usage, outputs that are for estimates which come at their own pace.
void refuse_network_outputs(const OutputOptions& options);

/// Looks up the hosts that estimates are sent to, which may take long: before anything waits for
/// the run. Fails where one is not known.
[[nodiscard]] tl::expected<void, Error> look_up_hosts(const OutputOptions& options);

/// What is told of a run to those who only get its estimates.
struct OutputSubject {
  const RigFile& rig;
  const RecordingHeader& header;
  EstimatorKind estimator{};
  /// The run is of use without estimates: it is recorded, or it drives lines.
  bool has_other_use = false;
};

/// Opens all outputs. Where samples come `live` each that may block has a thread of its own and
/// loses rows rather than hold the samples up; otherwise whoever hands on the estimates waits.
[[nodiscard]] tl::expected<std::unique_ptr<Outputs>, Error> open_outputs(
    const OutputOptions& options, bool live, const OutputSubject& subject);

}  // namespace penduline
