// SPDX-License-Identifier: Apache-2.0
// `penduline analyze`: a free swing in, the pendulum's physics out.
#include <fmt/format.h>

#include <array>
#include <memory>
#include <optional>
#include <string>

#include "host/analysis/analysis_report.hpp"
#include "host/analysis/angle_series.hpp"
#include "host/analysis/swing_analysis.hpp"
#include "host/cli/commands.hpp"
#include "host/cli/estimation_options.hpp"
#include "host/cli/log.hpp"
#include "host/cli/number_within.hpp"
#include "host/figure/figure.hpp"
#include "host/output/text_file.hpp"
#include "host/units.hpp"

namespace penduline {
namespace {

struct AnalyzeOptions {
  std::string path;
  std::string rig_path;
  std::optional<double> from_s;
  std::optional<double> to_s;
  std::optional<double> gravity_m_s2;
  std::optional<double> length_m;
  std::optional<double> latitude_deg;
  std::string format = "text";
  std::string plot_path;
  std::string output_path = "-";
  bool strict = false;
};

/// The angles of the file, and of a rig that goes with it what an analysis takes from it.
tl::expected<AngleSeries, Error> read_angles(const AnalyzeOptions& options,
                                             AnalysisSettings& settings) {
  const auto table = is_angle_table(options.path);
  if (!table) {
    return tl::unexpected(table.error());
  }
  if (options.rig_path.empty()) {
    return *table ? read_angle_table(options.path) : tl::unexpected(no_angles(options.path));
  }
  const auto rig = load_rig(options.rig_path);
  if (!rig) {
    return tl::unexpected(rig.error());
  }
  settings.gravity_m_s2 = options.gravity_m_s2.value_or(rig->rig.pendulum.gravity_m_s2);
  settings.mass_kg = rig->rig.pendulum.mass_kg;
  return *table ? read_angle_table(options.path) : angles_of_recording(options.path, rig->rig);
}

tl::expected<void, Error> write_report(const AnalyzeOptions& options,
                                       const SwingAnalysis& analysis) {
  auto file = TextFile::create(options.output_path);
  if (!file) {
    return tl::unexpected(file.error());
  }
  file->text() += options.format == "json" ? analysis_json(analysis, options.path)
                                           : analysis_text(analysis, options.path);
  return file->flush();
}

ExitStatus analyze(const AnalyzeOptions& options) {
  if (const auto file = require_file(options.path); !file) {
    return log_failure(file.error());
  }
  const std::array<std::string, 4> paths{options.path, options.rig_path, options.output_path,
                                         options.plot_path};
  if (const auto distinct = require_distinct_files(paths); !distinct) {
    return log_failure(distinct.error());
  }
  AnalysisSettings settings{.from_s = options.from_s, .to_s = options.to_s};
  settings.gravity_m_s2 = options.gravity_m_s2.value_or(settings.gravity_m_s2);
  settings.length_m = options.length_m;
  if (options.latitude_deg) {
    settings.latitude_rad = *options.latitude_deg * kDegree;
  }
  const auto series = read_angles(options, settings);
  if (!series) {
    return log_failure(series.error());
  }
  const auto analysis = analyze_swing(*series, settings);
  if (!analysis) {
    const std::string left_out = series->left_out_text();
    return log_failure({fmt::format("{}: {}{}{}", options.path, analysis.error().message,
                                    left_out.empty() ? "" : "; ", left_out)});
  }
  if (const auto written = write_report(options, *analysis); !written) {
    return log_failure(written.error());
  }
  if (!options.plot_path.empty()) {
    if (const auto drawn = draw(analysis_figure(*analysis), options.plot_path); !drawn) {
      return log_failure(drawn.error());
    }
  }
  if (series->left_out > 0) {
    log_warning(fmt::format("{}: {}", options.path, series->left_out_text()));
  }
  return options.strict && series->left_out > 0 ? ExitStatus::kDoubtful : ExitStatus::kDone;
}

void add_physics_options(CLI::App& command, AnalyzeOptions& options) {
  constexpr double kLargest = 1e6;
  CLI::Option* gravity =
      command
          .add_option("--gravity-m-s2", options.gravity_m_s2,
                      "Gravity, from which the effective length follows; else the rig's, or 9.8")
          ->check(number_within(1e-3, kLargest))
          ->type_name("G");
  command
      .add_option("--length-m", options.length_m,
                  "The pendulum's length, from which gravity follows instead")
      ->excludes(gravity)
      ->check(number_within(1e-6, kLargest))
      ->type_name("L");
  command
      .add_option("--latitude-deg", options.latitude_deg,
                  "Where the pendulum stands, north above 0: tells the Earth's rotation")
      ->check(number_within(-90, 90))
      ->type_name("DEG");
}

}  // namespace

void add_analyze_command(CLI::App& program, ExitStatus& status) {
  auto options = std::make_shared<AnalyzeOptions>();
  CLI::App* command = program.add_subcommand(
      "analyze", "Period, damping, ellipse and precession of a free swing, with uncertainties");
  command
      ->add_option("FILE", options->path,
                   "A recording (with --rig), or a table of angles: estimates as CSV, or the\n"
                   "columns t_s,theta_rad")
      ->required();
  command
      ->add_option("--rig", options->rig_path,
                   "The rig file (docs/formats.md): what turns a recording into angles")
      ->type_name("FILE");
  constexpr double kLatestS = 1e12;
  command
      ->add_option("--from-s", options->from_s,
                   "Where the part to analyse begins; unless said, the free swing is found")
      ->check(number_within(-kLatestS, kLatestS))
      ->type_name("T");
  command->add_option("--to-s", options->to_s, "Where it ends")
      ->check(number_within(-kLatestS, kLatestS))
      ->type_name("T");
  add_physics_options(*command, *options);
  command->add_option("--format", options->format, "text to read, json to go on with")
      ->check(CLI::IsMember({"text", "json"}).description(""))
      ->type_name("text|json")
      ->capture_default_str();
  command
      ->add_option("-o,--output", options->output_path,
                   "Where the report goes; - is the standard output")
      ->type_name("FILE")
      ->capture_default_str();
  command
      ->add_option("--plot", options->plot_path,
                   "Draw angles, residuals, decay, periods and path: .svg, .pdf or .png")
      ->type_name("FILE");
  command->add_flag("--strict", options->strict, "End with status 3 where rows had to be left out");
  command->footer(
      "What each figure means: docs/analysis.md; the keys of the JSON: docs/formats.md.\n\n"
      "  penduline analyze rec.csv --rig rig.toml --plot swing.svg\n"
      "  penduline analyze angles.csv --latitude-deg 48 --format json -o swing.json");
  command->final_callback([options, &status] { status = analyze(*options); });
}

}  // namespace penduline
