// SPDX-License-Identifier: Apache-2.0
// Reading angles, and what can be trusted of them.
#include "host/analysis/angle_series.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/pipeline.hpp"
#include "hal/replay/cells.hpp"
#include "host/source/source.hpp"

namespace penduline {
namespace {

void leave_out(bool without_angles, Flags against, AngleSeries& series) {
  ++series.left_out;
  series.without_angles += without_angles ? 1U : 0U;
  series.flags_against.count(against);
}

/// Puts a row's angles into the series, or counts it as left out.
tl::expected<void, Error> take_row(const NumberTable& table, const AngleColumns& columns,
                                   AngleSeries& series) {
  const auto flags = columns.flags ? table.number(*columns.flags) : 0;
  if (!flags) {
    return tl::unexpected(flags.error());
  }
  const bool empty =
      table.is_empty(columns.theta1) || (columns.theta2 && table.is_empty(*columns.theta2));
  const Flags against = static_cast<Flags>(*flags) & ~kHarmlessToAngles;
  if (empty || against != 0) {
    leave_out(empty, against, series);
    return {};
  }
  const auto t_s = table.number(columns.t_s);
  const auto theta1_rad = table.number(columns.theta1);
  const auto theta2_rad = columns.theta2 ? table.number(*columns.theta2) : 0;
  for (const auto* number : {&t_s, &theta1_rad, &theta2_rad}) {
    if (!*number) {
      return tl::unexpected(number->error());
    }
  }
  if (!series.t_s.empty() && !(*t_s > series.t_s.back())) {
    return failure(fmt::format("{}: the time went from {} s to {} s, expected it to rise",
                               table.place(), series.t_s.back(), *t_s));
  }
  series.t_s.push_back(*t_s);
  series.theta1_rad.push_back(*theta1_rad);
  series.theta2_rad.push_back(*theta2_rad);
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

AngleSeries AngleSeries::thinned(std::size_t stride) const {
  AngleSeries result = *this;
  for (auto* values : {&result.t_s, &result.theta1_rad, &result.theta2_rad}) {
    for (std::size_t i = 0; i * stride < values->size(); ++i) {
      (*values)[i] = (*values)[i * stride];
    }
    values->resize((values->size() + stride - 1) / stride);
  }
  return result;
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
  const auto table = NumberTable::open(path);
  if (!table) {
    return tl::unexpected(table.error());
  }
  return table->names().find("theta") != std::string::npos;
}

Error no_angles(const std::string& path) {
  return {one_line(
      fmt::format("{}: found no angles; a recording needs --rig, a table the columns t_s with "
                  "theta1_rad and theta2_rad, or theta_rad",
                  path))};
}

tl::expected<AngleColumns, Error> find_angle_columns(const NumberTable& table) {
  const auto time = table.column("t_s");
  const auto only = table.column("theta_rad");
  const auto first = only ? only : table.column("theta1_rad");
  const auto second = only ? std::nullopt : table.column("theta2_rad");
  if (!time || !first || (!only && !second)) {
    return failure(fmt::format(
        "{}: found the columns '{}', expected t_s with theta1_rad and theta2_rad, or with "
        "theta_rad",
        table.place(), excerpt(table.names())));
  }
  return AngleColumns{
      .t_s = *time, .theta1 = *first, .theta2 = second, .flags = table.column("flags")};
}

tl::expected<AngleSeries, Error> read_angle_table(const std::string& path) {
  auto table = NumberTable::open(path);
  if (!table) {
    return tl::unexpected(table.error());
  }
  const auto columns = find_angle_columns(*table);
  if (!columns) {
    return tl::unexpected(columns.error());
  }
  AngleSeries series{.planar = !columns->theta2};
  return table->for_each_row([&] { return take_row(*table, *columns, series); }).map([&] {
    return std::move(series);
  });
}

tl::expected<AngleSeries, Error> angles_of_recording(const std::string& path,
                                                     const Rig<double>& rig,
                                                     const std::function<bool()>& stopped) {
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
    if (stopped && stopped()) {
      return failure(path + ": stopped while reading");
    }
    const Estimate<double> estimate = pipeline.update(sample);
    const Flags against = estimate.flags & ~kHarmlessToAngles;
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
