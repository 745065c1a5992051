// SPDX-License-Identifier: Apache-2.0
// `penduline plot`: recordings or estimates in, one figure out.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hal/replay/cells.hpp"
#include "host/cli/commands.hpp"
#include "host/cli/estimation_options.hpp"
#include "host/cli/log.hpp"
#include "host/cli/number_within.hpp"
#include "host/figure/figure.hpp"
#include "host/output/text_file.hpp"
#include "host/plot/estimate_input.hpp"
#include "host/plot/plot_kinds.hpp"

namespace penduline {
namespace {

constexpr std::size_t kMostFiles = 6;  // as many as there are colours

struct PlotOptions {
  std::vector<std::string> paths;
  std::string kind;
  std::string rig_path;
  EstimatorOptions estimator;
  std::optional<double> from_s;
  std::optional<double> to_s;
  std::optional<std::string> title;
  std::string size;
  std::string output_path;
  bool strict = false;
};

/// "900x600", both within what a drawing may be; none where the text is another.
std::optional<FigureSize> parse_size(const std::string& text) {
  constexpr int kLeastPx = 200;
  constexpr int kMostPx = 10000;
  const std::size_t by = text.find('x');
  if (by == std::string::npos) {
    return std::nullopt;
  }
  const auto width = parse_number<int>(text.substr(0, by));
  const auto height = parse_number<int>(text.substr(by + 1));
  const auto good = [](const std::optional<int>& size) {
    return size && *size >= kLeastPx && *size <= kMostPx;
  };
  if (!good(width) || !good(height)) {
    return std::nullopt;
  }
  return FigureSize{.width_px = *width, .height_px = *height};
}

tl::expected<std::vector<EstimateSeries>, Error> read_inputs(const PlotOptions& options) {
  EstimateInput input{.estimator = options.estimator};
  if (!options.rig_path.empty()) {
    const auto rig = load_rig(options.rig_path);
    if (!rig) {
      return tl::unexpected(rig.error());
    }
    input.rig = rig->rig;
  }
  constexpr double kAny = std::numeric_limits<double>::infinity();
  const double from_s = options.from_s.value_or(-kAny);
  const double to_s = options.to_s.value_or(kAny);
  std::vector<EstimateSeries> inputs;
  for (const std::string& path : options.paths) {
    const auto series = read_estimates(path, input, log_warning);
    if (!series) {
      return tl::unexpected(series.error());
    }
    inputs.push_back(series->between(from_s, to_s));
    if (!any_known(inputs.back().theta1_rad)) {
      return failure(fmt::format("{}: found no angles from {} s to {} s, {} rows in all", path,
                                 from_s, to_s, series->size()));
    }
  }
  return inputs;
}

/// Tells of rows that are not as they should be; whether there are any.
bool tell_doubtful(const std::vector<EstimateSeries>& inputs) {
  bool any = false;
  for (const EstimateSeries& series : inputs) {
    std::size_t empty = 0;
    std::size_t flagged = 0;
    for (std::size_t row = 0; row < series.size(); ++row) {
      const auto flags = static_cast<Flags>(series.flags[row]);
      if (!series.answers(row)) {
        const bool waits = flags != 0 && (flags & ~flag::kOrdinary) == 0;  // a filter fills
        empty += waits ? 0U : 1U;
      } else if (!series.trusted(row)) {
        ++flagged;
      }
    }
    if (empty + flagged > 0) {
      log_warning(fmt::format("{}: {} rows without angles, {} with a flag against them",
                              series.name, empty, flagged));
      any = true;
    }
  }
  return any;
}

ExitStatus plot(const PlotOptions& options) {
  for (const std::string& path : options.paths) {
    if (const auto file = require_file(path); !file) {
      return log_failure(file.error());
    }
    const std::vector<std::string> paths{path, options.rig_path, options.output_path};
    if (const auto distinct = require_distinct_files(paths); !distinct) {
      return log_failure(distinct.error());
    }
  }
  const auto inputs = read_inputs(options);
  if (!inputs) {
    return log_failure(inputs.error());
  }
  const auto kind = std::ranges::find(plot_kinds(), options.kind, &PlotKind::name);
  auto figure =
      kind->make(*inputs, {.from_s = options.from_s, .to_s = options.to_s, .warn = log_warning});
  if (!figure) {
    return log_failure(figure.error());
  }
  figure->title = options.title.value_or(figure->title);
  if (!options.size.empty()) {
    figure->size = parse_size(options.size);
  }
  if (const auto drawn = draw(*figure, options.output_path); !drawn) {
    return log_failure(drawn.error());
  }
  return tell_doubtful(*inputs) && options.strict ? ExitStatus::kDoubtful : ExitStatus::kDone;
}

/// "angles: ...;\nxyz: ..." for the help.
std::string kinds_explained() {
  std::vector<std::string> lines;
  for (const PlotKind& kind : plot_kinds()) {
    lines.push_back(fmt::format("{}: {}", kind.name, kind.meaning));
  }
  return fmt::format("{}", fmt::join(lines, ";\n"));
}

void add_figure_options(CLI::App& command, PlotOptions& options) {
  std::vector<std::string> names;
  for (const PlotKind& kind : plot_kinds()) {
    names.emplace_back(kind.name);
  }
  command.add_option("--what", options.kind, kinds_explained())
      ->required()
      ->check(CLI::IsMember(names).description(""))
      ->type_name(fmt::format("{}", fmt::join(names, "|")));
  const CLI::Validator figure_name(
      [](const std::string& path) {
        const auto good = require_figure_name(path);
        return good ? std::string() : good.error().message;
      },
      "");
  command
      .add_option("-o,--output", options.output_path,
                  "The figure; its name ends in .svg, .pdf (both lines and text) or .png")
      ->required()
      ->check(figure_name)
      ->type_name("FILE");
  command
      .add_option("--title", options.title, "Above the figure, in place of what it shows; '': none")
      ->type_name("TEXT");
  const CLI::Validator size(
      [](const std::string& text) {
        return parse_size(text) ? std::string()
                                : fmt::format(
                                      "found {}, expected two sizes in pixels from 200 to "
                                      "10000, such as 900x600",
                                      text);
      },
      "");
  command
      .add_option("--size", options.size, "Width and height in pixels, a hundred an inch of a PDF")
      ->check(size)
      ->type_name("WxH");
}

}  // namespace

void add_plot_command(CLI::App& program, ExitStatus& status) {
  auto options = std::make_shared<PlotOptions>();
  CLI::App* command =
      program.add_subcommand("plot", "Draw a recording or estimates: angles, path, spectrum, ...");
  command
      ->add_option("FILE", options->paths,
                   "Recordings (with --rig) or tables of angles, as 'replay' prints them; up to\n"
                   "six are drawn over each other")
      ->required();
  add_figure_options(*command, *options);
  command
      ->add_option("--rig", options->rig_path,
                   "The rig file (docs/formats.md): what turns recordings into angles, and a\n"
                   "table of angles alone into positions")
      ->type_name("FILE");
  add_estimator_options(*command, options->estimator);
  constexpr double kLatestS = 1e12;
  command->add_option("--from-s", options->from_s, "Where the part to draw begins")
      ->check(number_within(-kLatestS, kLatestS))
      ->type_name("T");
  command->add_option("--to-s", options->to_s, "Where it ends")
      ->check(number_within(-kLatestS, kLatestS))
      ->type_name("T");
  command->add_flag("--strict", options->strict,
                    "End with status 3 where rows had no angles or a flag against them");
  command->footer(
      "What each figure shows: docs/figures.md. It needs gnuplot.\n\n"
      "  penduline plot rec.csv --rig rig.toml --what angles -o angles.svg\n"
      "  penduline plot gn.csv ekf.csv --what top --title 'Two estimators' -o path.pdf");
  command->final_callback([options, &status] {
    if (options->paths.size() > kMostFiles) {
      throw CLI::ValidationError(
          "FILE", fmt::format("found {}, expected {} or less", options->paths.size(), kMostFiles));
    }
    status = plot(*options);
  });
}

}  // namespace penduline
