// SPDX-License-Identifier: Apache-2.0
// `penduline simulate`: makes recordings with known truth.
#include <fmt/format.h>

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "hal/replay/recording_format.hpp"
#include "hal/sim/sampled_rig.hpp"
#include "host/cli/commands.hpp"
#include "host/cli/estimation_options.hpp"
#include "host/cli/log.hpp"
#include "host/cli/simulation_options.hpp"
#include "host/output/fixed_decimals.hpp"
#include "host/output/text_file.hpp"
#include "host/session/progress_bar.hpp"
#include "host/session/stop_signal.hpp"
#include "host/source/source.hpp"

namespace penduline {
namespace {

struct SimulateOptions {
  SimulationOptions simulation;
  std::string rig_path;
  std::string output_path = "-";
  std::string truth_path;
};

/// The truth beside the recording, row by row.
class TruthFile {
 public:
  static tl::expected<TruthFile, Error> create(const std::string& path, double length_m) {
    auto file = TextFile::create(path);
    if (!file) {
      return tl::unexpected(file.error());
    }
    file->text() += "seq,t_us,theta1_rad,theta2_rad,omega1_rad_s,omega2_rad_s,x_m,y_m,z_m\n";
    return TruthFile(std::move(*file), length_m);
  }

  tl::expected<void, Error> append(const Sample& sample, const SwingState<double>& state) {
    constexpr std::size_t kDecimals = 9;
    // Straight from the angles: an Euler scheme may swing past the horizontal, where no plane has
    // slopes.
    const double cos2 = std::cos(state.theta2_rad);
    const std::array values = {state.theta1_rad,
                               state.theta2_rad,
                               state.omega1_rad_s,
                               state.omega2_rad_s,
                               -length_m_ * std::sin(state.theta2_rad),
                               length_m_ * std::sin(state.theta1_rad) * cos2,
                               -length_m_ * std::cos(state.theta1_rad) * cos2};
    file_.text() += fmt::format("{},{}", sample.seq, sample.t_us);
    for (const double value : values) {
      file_.text() += ',';
      append_fixed(file_.text(), value, kDecimals);
    }
    file_.text() += '\n';
    return file_.flush_if_large();
  }

  tl::expected<void, Error> flush() { return file_.flush(); }

 private:
  TruthFile(TextFile file, double length_m) : file_(std::move(file)), length_m_(length_m) {}

  TextFile file_;
  double length_m_;
};

/// Simulates until the end or a request to stop; returns how many samples were made.
tl::expected<std::uint64_t, Error> write_simulation(SampledRig& rig, TextFile& recording,
                                                    std::optional<TruthFile>& truth,
                                                    bool rows_on_stdout) {
  const StopSignal stop;
  ProgressBar progress(rows_on_stdout);
  Sample sample;
  std::uint64_t count = 0;
  recording.text() += recording_head(simulated_header(rig));
  while (!stop.requested()) {
    const auto more = rig.read(sample);
    if (!more) {
      return tl::unexpected(more.error());
    }
    if (!*more) {
      break;
    }
    ++count;
    append_recording_row(recording.text(), sample, rig.acquisition().sensor_count);
    if (const auto flushed = recording.flush_if_large(); !flushed) {
      return tl::unexpected(flushed.error());
    }
    if (truth) {
      if (const auto written = truth->append(sample, rig.truth()); !written) {
        return tl::unexpected(written.error());
      }
    }
    if (progress.due()) {
      progress.draw(rig.progress());
    }
  }
  return count;
}

tl::expected<std::uint64_t, Error> simulate(const SimulateOptions& options) {
  const auto rig_file = load_rig(options.rig_path);
  if (!rig_file) {
    return tl::unexpected(rig_file.error());
  }
  const std::array<std::string, 3> paths{named_input(options.rig_path), options.output_path,
                                         options.truth_path};
  if (const auto distinct = require_distinct_files(paths); !distinct) {
    return tl::unexpected(distinct.error());
  }
  SampledRig rig(rig_file->rig, simulation_settings(options.simulation, rig_file->rig));
  auto recording = TextFile::create(options.output_path);
  if (!recording) {
    return tl::unexpected(recording.error());
  }
  std::optional<TruthFile> truth;
  if (!options.truth_path.empty()) {
    auto created = TruthFile::create(options.truth_path, rig_file->rig.pendulum.length_m);
    if (!created) {
      return tl::unexpected(created.error());
    }
    truth.emplace(std::move(*created));
  }
  auto count = write_simulation(rig, *recording, truth, options.output_path == "-");
  for (const std::string& complaint : simulation_complaints(rig)) {
    log_warning(complaint);
  }
  // What was simulated before a failure is kept.
  const auto recorded = recording->flush();
  const auto told = truth ? truth->flush() : tl::expected<void, Error>();
  if (count && (!recorded || !told)) {
    return tl::unexpected(recorded ? told.error() : recorded.error());
  }
  return count;
}

}  // namespace

void add_simulate_command(CLI::App& program, ExitStatus& status) {
  auto options = std::make_shared<SimulateOptions>();
  CLI::App* command =
      program.add_subcommand("simulate", "Make a recording of a simulated rig, with its truth");
  add_rig_option(*command, options->rig_path);
  command
      ->add_option("-o,--output", options->output_path,
                   "Where the recording goes; - is the standard output")
      ->type_name("FILE")
      ->capture_default_str();
  command->add_option("--truth", options->truth_path, "Where the true angles and positions go")
      ->type_name("FILE");
  add_simulation_options(*command, options->simulation,
                         "How long to simulate; else 10 s, for case 2 the paper's 50 s");
  command->footer(
      "The sensors are the rig's own, with what the options add: noise, ambient light, an ADC.\n\n"
      "  penduline simulate --case 1 --rig rig.toml -o rec.csv --truth truth.csv\n"
      "  penduline simulate --theta-deg 15 --psi 3 --seconds 60 --gap-noise 50e-6 --rig rig.toml");
  command->final_callback([options, &status] {
    const auto count = simulate(*options);
    if (!count) {
      status = log_failure(count.error());
      return;
    }
    log_info(fmt::format("{} samples simulated", *count));
    status = ExitStatus::kDone;
  });
}

}  // namespace penduline
