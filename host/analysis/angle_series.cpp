// SPDX-License-Identifier: Apache-2.0
// Reading angles, and what can be trusted of them.
#include "host/analysis/angle_series.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "common/pipeline.hpp"
#include "hal/replay/cells.hpp"
#include "hal/replay/line_reader.hpp"
#include "host/source/source.hpp"

namespace penduline {
namespace {

/// Angles near a restart or after a dropout are as good as others: each stands for itself.
constexpr Flags kHarmless = flag::kOrdinary | flag::kOverrun | flag::kLate | flag::kDropout;

/// Goes to the next whole line that is neither blank nor a comment; false at the end. What stands
/// behind the last newline may have lost digits, and one row matters to no analysis.
tl::expected<bool, Error> next_line(LineReader& lines) {
  while (true) {
    const auto outcome = lines.next();
    if (!outcome) {
      return tl::unexpected(outcome.error());
    }
    if (*outcome != LineReader::Outcome::kLine) {
      return false;
    }
    if (!trimmed(lines.line()).empty() && !lines.line().starts_with('#')) {
      return true;
    }
  }
}

/// Where the columns stand in a row.
struct Columns {
  std::size_t count = 0;
  std::size_t t_s = 0;
  std::size_t theta1 = 0;
  std::optional<std::size_t> theta2;
  std::optional<std::size_t> flags;
};

std::optional<Columns> find_columns(std::string_view line) {
  const auto names = split_cells(line, ",");
  const auto at = [&](std::string_view name) -> std::optional<std::size_t> {
    const auto found = std::ranges::find(names, name);
    if (found == names.end()) {
      return std::nullopt;
    }
    return static_cast<std::size_t>(found - names.begin());
  };
  const auto time = at("t_s");
  const auto only = at("theta_rad");
  const auto first = only ? only : at("theta1_rad");
  const auto second = only ? std::nullopt : at("theta2_rad");
  if (!time || !first || (!only && !second)) {
    return std::nullopt;
  }
  return Columns{.count = names.size(),
                 .t_s = *time,
                 .theta1 = *first,
                 .theta2 = second,
                 .flags = at("flags")};
}

void leave_out(bool without_angles, Flags against, AngleSeries& series) {
  ++series.left_out;
  series.without_angles += without_angles ? 1U : 0U;
  series.flags_against.count(against);
}

/// Puts a row's angles into the series, or counts it as left out.
tl::expected<void, Error> take_row(const LineReader& lines, const Columns& columns,
                                   AngleSeries& series) {
  const auto cells = split_cells(lines.line(), ",");
  if (cells.size() != columns.count) {
    return failure(
        fmt::format("{}: found {} cells, expected {}", lines.place(), cells.size(), columns.count));
  }
  std::optional<Error> wrong;
  const auto number = [&](std::size_t column) {
    const auto value = parse_number<double>(cells[column]);
    if (!value || !std::isfinite(*value)) {
      wrong = Error{one_line(fmt::format("{}: found '{}' in column {}, expected a number",
                                         lines.place(), excerpt(cells[column]), column + 1))};
    }
    return value.value_or(0);
  };
  const bool empty =
      is_missing(cells[columns.theta1]) || (columns.theta2 && is_missing(cells[*columns.theta2]));
  const double flags = columns.flags ? number(*columns.flags) : 0;
  const Flags against = static_cast<Flags>(flags) & ~kHarmless;
  if (!wrong && (empty || against != 0)) {
    leave_out(empty, against, series);
    return {};
  }
  const double t_s = number(columns.t_s);
  const double theta1_rad = number(columns.theta1);
  const double theta2_rad = columns.theta2 ? number(*columns.theta2) : 0;
  if (wrong) {
    return tl::unexpected(*wrong);
  }
  if (!series.t_s.empty() && !(t_s > series.t_s.back())) {
    return failure(fmt::format("{}: the time went from {} s to {} s, expected it to rise",
                               lines.place(), series.t_s.back(), t_s));
  }
  series.t_s.push_back(t_s);
  series.theta1_rad.push_back(theta1_rad);
  series.theta2_rad.push_back(theta2_rad);
  return {};
}

}  // namespace

AngleSeries AngleSeries::between(double from_s, double to_s) const {
  const auto begin = std::ranges::lower_bound(t_s, from_s) - t_s.begin();
  const auto end = std::max(std::ranges::upper_bound(t_s, to_s) - t_s.begin(), begin);
  const auto part = [&](const std::vector<double>& values) {
    return std::vector<double>(values.begin() + begin, values.begin() + end);
  };
  return {.t_s = part(t_s),
          .theta1_rad = part(theta1_rad),
          .theta2_rad = part(theta2_rad),
          .planar = planar,
          .left_out = left_out,
          .without_angles = without_angles,
          .flags_against = flags_against};
}

std::string AngleSeries::left_out_text() const {
  if (left_out == 0) {
    return "";
  }
  std::string reasons = without_angles > 0 ? fmt::format("{} without angles", without_angles) : "";
  if (const std::string flags = flags_against.text(); !flags.empty()) {
    reasons += (reasons.empty() ? "" : "; ") + flags;
  }
  if (reasons.empty()) {
    reasons = "flags that this version does not know";
  }
  return fmt::format("{} of {} rows are left out ({})", left_out, left_out + size(), reasons);
}

double AngleSeries::period_s() const {
  if (size() < 2) {
    return 0;
  }
  std::vector<double> steps(size() - 1);
  std::ranges::transform(t_s.begin() + 1, t_s.end(), t_s.begin(), t_s.end() - 1, steps.begin(),
                         std::minus<>());
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::ranges::nth_element(steps, middle);
  return *middle;
}

tl::expected<bool, Error> is_angle_table(const std::string& path) {
  auto lines = LineReader::open(path);
  if (!lines) {
    return tl::unexpected(lines.error());
  }
  const auto more = next_line(*lines);
  if (!more) {
    return tl::unexpected(more.error());
  }
  return *more && lines->line().find("theta") != std::string_view::npos;
}

tl::expected<AngleSeries, Error> read_angle_table(const std::string& path) {
  auto lines = LineReader::open(path);
  if (!lines) {
    return tl::unexpected(lines.error());
  }
  auto more = next_line(*lines);
  if (!more) {
    return tl::unexpected(more.error());
  }
  const auto columns = *more ? find_columns(lines->line()) : std::nullopt;
  if (!columns) {
    return failure(fmt::format(
        "{}: found the columns '{}', expected t_s with theta1_rad and theta2_rad, or with "
        "theta_rad",
        lines->place(), *more ? excerpt(lines->line()) : ""));
  }
  AngleSeries series{.planar = !columns->theta2};
  while (true) {
    more = next_line(*lines);
    if (!more) {
      return tl::unexpected(more.error());
    }
    if (!*more) {
      return series;
    }
    if (const auto taken = take_row(*lines, *columns, series); !taken) {
      return tl::unexpected(taken.error());
    }
  }
}

tl::expected<AngleSeries, Error> angles_of_recording(const std::string& path,
                                                     const Rig<double>& rig) {
  auto source = open_recording(path);
  if (!source) {
    return tl::unexpected(source.error());
  }
  const Acquisition<double> acquisition = (*source)->header().acquisition;
  if (rig.layout.count != acquisition.sensor_count) {
    return failure(fmt::format("{}: the rig has {} sensors, the samples have {}", path,
                               rig.layout.count, acquisition.sensor_count));
  }
  Rig<double> unfiltered = rig;
  unfiltered.filter = FilterDesign<double>{};
  Pipeline<double> pipeline(unfiltered, acquisition);
  AngleSeries series;
  Sample sample;
  while (true) {
    const auto more = (*source)->read(sample);
    if (!more) {
      return tl::unexpected(more.error());
    }
    if (*more != ReadResult::kSample) {
      return series;
    }
    const Estimate<double> estimate = pipeline.update(sample);
    const Flags against = estimate.flags & ~kHarmless;
    if (!estimate.attitude || against != 0) {
      leave_out(!estimate.attitude, against, series);
      continue;
    }
    const double t_s = 1e-6 * static_cast<double>(estimate.t_us);
    if (!series.t_s.empty() && !(t_s > series.t_s.back())) {
      return failure(
          fmt::format("{}: the board's clock started anew after {} s; analyse each part by itself",
                      (*source)->place(), series.t_s.back()));
    }
    series.t_s.push_back(t_s);
    series.theta1_rad.push_back(estimate.attitude->angles.theta1_rad);
    series.theta2_rad.push_back(estimate.attitude->angles.theta2_rad);
  }
}

}  // namespace penduline
