// SPDX-License-Identifier: Apache-2.0
// From a table of known points and its recordings to gap and signal.
#include "host/calibration/points_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <numbers>
#include <string_view>

#include "hal/replay/cells.hpp"
#include "hal/replay/line_reader.hpp"

#include "host/units.hpp"

namespace penduline {
namespace {

std::string gap_column(std::size_t sensor) {
  return sensor < 2 ? fmt::format("gap_{}_mm", "xy"[sensor])
                    : fmt::format("gap_s{}_mm", sensor + 1);
}

/// The columns of a table, by what a row's cell says.
struct Columns {
  std::vector<std::string> names;
  std::vector<std::string> known;

  [[nodiscard]] bool has(std::string_view name) const {
    return std::ranges::find(names, name) != names.end();
  }
};

tl::expected<Columns, Error> parse_columns(std::string_view line, const std::string& place,
                                           std::size_t sensor_count) {
  Columns columns{.names = {},
                  .known = {"recording", "from_s", "to_s", "theta1_deg", "theta2_deg"}};
  for (std::size_t i = 0; i < sensor_count; ++i) {
    columns.known.push_back(gap_column(i));
  }
  for (const std::string_view cell : split_cells(line, ",")) {
    if (std::ranges::find(columns.known, cell) == columns.known.end() || columns.has(cell)) {
      return failure(fmt::format("{}: found column '{}', expected each at most once of {}", place,
                                 excerpt(cell), fmt::join(columns.known, ", ")));
    }
    columns.names.emplace_back(cell);
  }
  const bool gaps = std::ranges::any_of(
      columns.names, [](const std::string& name) { return name.starts_with("gap_"); });
  const bool one_angle = columns.has("theta1_deg") || columns.has("theta2_deg");
  const bool both_angles = columns.has("theta1_deg") && columns.has("theta2_deg");
  if (gaps == one_angle || one_angle != both_angles) {
    return failure(
        fmt::format("{}: expected either theta1_deg and theta2_deg or gaps such as "
                    "gap_x_mm among the columns",
                    place));
  }
  if (columns.has("from_s") != columns.has("to_s")) {
    return failure(fmt::format("{}: expected from_s and to_s together", place));
  }
  return columns;
}

/// One row's numbers by column; NaN where the cell is empty.
tl::expected<std::map<std::string, double, std::less<>>, Error> parse_numbers(
    const std::vector<std::string_view>& cells, const Columns& columns, const std::string& place) {
  std::map<std::string, double, std::less<>> numbers;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const std::string& name = columns.names[i];
    if (name == "recording") {
      continue;
    }
    const bool may_be_empty = name.starts_with("gap_");
    const auto number = parse_number<double>(cells[i]);
    if (number && std::isfinite(*number)) {
      numbers[name] = *number;
    } else if (may_be_empty && is_missing(cells[i])) {
      numbers[name] = std::numeric_limits<double>::quiet_NaN();
    } else {
      return failure(
          fmt::format("{}: {}: found '{}', expected a number", place, name, excerpt(cells[i])));
    }
  }
  return numbers;
}

tl::expected<KnownPoint, Error> parse_point(std::string_view line, const Columns& columns,
                                            const std::string& place,
                                            const std::filesystem::path& folder,
                                            const std::string& recording,
                                            std::size_t sensor_count) {
  const std::vector<std::string_view> cells = split_cells(line, ",");
  if (cells.size() != columns.names.size()) {
    return failure(
        fmt::format("{}: found {} cells, expected {}", place, cells.size(), columns.names.size()));
  }
  const auto numbers = parse_numbers(cells, columns, place);
  if (!numbers) {
    return tl::unexpected(numbers.error());
  }
  const auto number_or = [&](std::string_view name, double otherwise) {
    const auto found = numbers->find(name);
    return found == numbers->end() ? otherwise : found->second;
  };
  KnownPoint point{.place = place, .recording = recording};
  if (const auto column = std::ranges::find(columns.names, "recording");
      column != columns.names.end()) {
    point.recording =
        (folder / cells[static_cast<std::size_t>(column - columns.names.begin())]).string();
  } else if (recording.empty()) {
    return failure(
        fmt::format("{}: expected a column 'recording', or the recording as an argument", place));
  }
  point.from_s = number_or("from_s", point.from_s);
  point.to_s = number_or("to_s", point.to_s);
  if (!(point.from_s < point.to_s)) {
    return failure(fmt::format("{}: found from_s {}, to_s {}, expected from_s to be less", place,
                               point.from_s, point.to_s));
  }
  if (columns.has("theta1_deg")) {
    point.angles = {.theta1_rad = number_or("theta1_deg", 0) * kDegree,
                    .theta2_rad = number_or("theta2_deg", 0) * kDegree};
    if (!(std::abs(point.angles->theta1_rad) < std::numbers::pi / 3) ||
        !(std::abs(point.angles->theta2_rad) < std::numbers::pi / 3)) {
      return failure(fmt::format("{}: found {} and {} deg, expected angles within 60 deg", place,
                                 number_or("theta1_deg", 0), number_or("theta2_deg", 0)));
    }
  }
  for (std::size_t i = 0; i < sensor_count; ++i) {
    point.gap_m[i] =
        number_or(gap_column(i), std::numeric_limits<double>::quiet_NaN()) * kMillimetre;
  }
  return point;
}

}  // namespace

tl::expected<std::vector<KnownPoint>, Error> read_points(const std::string& path,
                                                         const std::string& recording,
                                                         std::size_t sensor_count) {
  auto lines = LineReader::open(path);
  if (!lines) {
    return tl::unexpected(lines.error());
  }
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  std::optional<Columns> columns;
  std::vector<KnownPoint> points;
  while (true) {
    const auto outcome = lines->next();
    if (!outcome) {
      return tl::unexpected(outcome.error());
    }
    if (*outcome == LineReader::Outcome::kEndOfFile) {
      break;
    }
    const std::string_view line = trimmed(lines->line());
    if (line.empty() || line.starts_with('#')) {
      continue;
    }
    if (!columns) {
      auto parsed = parse_columns(line, lines->place(), sensor_count);
      if (!parsed) {
        return tl::unexpected(parsed.error());
      }
      columns = std::move(*parsed);
      continue;
    }
    auto point = parse_point(line, *columns, lines->place(), folder, recording, sensor_count);
    if (!point) {
      return tl::unexpected(point.error());
    }
    points.push_back(std::move(*point));
  }
  if (points.empty()) {
    return failure(fmt::format("{}: found no points, expected column names and rows", path));
  }
  return points;
}

tl::expected<SensorPoints, Error> measure_points(const std::vector<KnownPoint>& points,
                                                 const SensorLayout<double>& layout,
                                                 std::vector<std::string>& complaints) {
  constexpr std::size_t kFewest = 5;
  /// A signal that varies by more, beside its noise, is that of a disc that moves.
  constexpr double kStillShare = 0.01;
  std::map<std::string, SignalLog> logs;
  SensorPoints result;
  for (const KnownPoint& point : points) {
    if (!logs.contains(point.recording)) {
      auto log = read_signals(point.recording, layout.count);
      if (!log) {
        return tl::unexpected(log.error());
      }
      complaints.insert(complaints.end(), log->complaints.begin(), log->complaints.end());
      logs.emplace(point.recording, std::move(*log));
    }
    for (std::size_t i = 0; i < layout.count; ++i) {
      const double gap_m = point.angles
                               ? DiscPlane<double>(slopes_of(*point.angles)).gap_m(layout, i)
                               : point.gap_m[i];
      if (!std::isfinite(gap_m)) {
        continue;
      }
      const MeanSignal mean =
          mean_signal(logs.at(point.recording).signals(i, point.from_s, point.to_s));
      if (mean.count < kFewest) {
        return failure(fmt::format("{}: found {} samples of sensor {}, expected {} or more",
                                   point.place, mean.count, i + 1, kFewest));
      }
      if (mean.slow_scatter_v > kStillShare * std::abs(mean.volts) + 1e-3) {
        return failure(fmt::format(
            "{}: the signal of sensor {} varies by {:.1f} mV about {:.3f} V, expected a disc that "
            "is held still",
            point.place, i + 1, mean.slow_scatter_v * 1e3, mean.volts));
      }
      result[i].push_back({.place = point.place,
                           .angles = point.angles,
                           .gap_m = gap_m,
                           .volts = mean.volts,
                           .standard_error_v = mean.standard_error_v()});
    }
  }
  return result;
}

}  // namespace penduline
