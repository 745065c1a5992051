// SPDX-License-Identifier: Apache-2.0
// Reading recordings: rows by hand because there are millions of them.
#include "hal/replay/recording_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

#include "hal/replay/cells.hpp"
#include "hal/replay/recording_header.hpp"

namespace penduline {
namespace {

constexpr std::size_t kMaxHeaderLines = 1000;
/// What the head of a recording that was joined to another begins with.
constexpr std::string_view kJoinedStart = "# penduline_recording = ";
/// What every reader of CSV and JSON keeps exactly, for they know doubles only.
constexpr std::uint64_t kLargestExact = (std::uint64_t{1} << 53U) - 1;
constexpr std::uint64_t kDeviceFlags = 0xff;

/// How many sensors a line of column names has: those whose `_on` and `_off` are both there, in
/// order and without a gap.
std::size_t count_sensors(const std::vector<std::string_view>& names) {
  const auto has = [&](const std::string& name) {
    return std::ranges::find(names, name) != names.end();
  };
  std::size_t count = 0;
  while (count < kMaxSensors &&
         (has(sensor_prefix(count) + "_on") || has(sensor_prefix(count) + "_off"))) {
    ++count;
  }
  return count;
}

bool is_reading(const Column& column) {
  return column.field == Field::kOn || column.field == Field::kOff;
}

struct ParsedCell {
  std::string_view text;
  std::optional<std::uint64_t> number;  ///< none where the text is no whole number from 0 up
};

/// A cell that is not just digits: blanks around them, or a decimal point that tools which know NaN
/// put behind every number of a column.
std::optional<std::uint64_t> parse_unusual_number(std::string_view text) {
  const auto number = parse_number<double>(text);
  if (!number || *number < 0 || *number > static_cast<double>(kLargestExact) ||
      *number != std::floor(*number)) {
    return std::nullopt;
  }
  return static_cast<std::uint64_t>(*number);
}

/// The cell that begins at `begin` in a line that ends at `end`.
ParsedCell parse_cell(const char* begin, const char* end) {
  std::uint64_t number = 0;
  const auto [stop, error] = std::from_chars(begin, end, number);
  if (error == std::errc{} && (stop == end || *stop == ',')) {
    return {.text = {begin, stop}, .number = number};
  }
  const std::string_view text(begin, std::find(begin, end, ','));
  return {.text = text, .number = parse_unusual_number(text)};
}

/// The largest number that a column may hold.
std::uint64_t largest_number(const Column& column, const Acquisition<double>& acquisition) {
  switch (column.field) {
    case Field::kOn:
    case Field::kOff:
      return static_cast<std::uint64_t>(acquisition.full_scale_counts);
    case Field::kFlags:
      return kDeviceFlags;
    default:
      return kLargestExact;
  }
}

/// Puts a number that is not too large in its place in the sample.
void store(const Column& column, std::uint64_t number, Sample& sample) {
  switch (column.field) {
    case Field::kSeq:
      sample.seq = number;
      break;
    case Field::kTime:
      sample.t_us = static_cast<std::int64_t>(number);
      break;
    case Field::kOn:
      sample.readings[column.sensor].on = static_cast<std::int32_t>(number);
      break;
    case Field::kOff:
      sample.readings[column.sensor].off = static_cast<std::int32_t>(number);
      break;
    case Field::kFlags:
      sample.flags = static_cast<Flags>(number);
      break;
  }
}

}  // namespace

tl::expected<RecordingReader, Error> RecordingReader::open(const std::string& path) {
  auto lines = LineReader::open(path);
  if (!lines) {
    return tl::unexpected(lines.error());
  }
  RecordingReader reader(std::move(*lines));
  if (const auto done = reader.read_header(); !done) {
    return tl::unexpected(done.error());
  }
  return reader;
}

tl::expected<void, Error> RecordingReader::read_header(std::string header) {
  const std::uint64_t first_line = std::max(lines_.line_number(), std::uint64_t{1});
  for (std::size_t count = 0; count < kMaxHeaderLines; ++count) {
    const auto outcome = lines_.next();
    if (!outcome) {
      return tl::unexpected(outcome.error());
    }
    if (*outcome == LineReader::Outcome::kEndOfFile) {
      return count == 0 && header.empty()
                 ? failure(fmt::format("{}: the file is empty, expected a recording that "
                                       "begins with '# {} = {}'",
                                       lines_.name(), kVersionKey, kRecordingVersion))
                 : failure(fmt::format("{}: the file ends after line {}, in its header; "
                                       "expected the column names seq,t_us,...",
                                       lines_.name(), lines_.line_number()));
    }
    const std::string_view line = lines_.line();
    if (line.empty() || line.starts_with('#')) {
      header += line.substr(line.empty() ? 0 : 1);
      header += '\n';
      continue;
    }
    if (header.find_first_not_of('\n') == std::string::npos) {
      return failure(
          fmt::format("{}: found '{}', expected a recording that begins with '# {} = {}' "
                      "(plain logs of voltages are read with --import)",
                      lines_.place(), excerpt(line), kVersionKey, kRecordingVersion));
    }
    auto parsed = parse_recording_header(header, lines_.name(), first_line);
    if (!parsed) {
      return tl::unexpected(parsed.error());
    }
    header_ = std::move(*parsed);
    return parse_column_names(line);
  }
  return failure(
      fmt::format("{}: the header has more than {} lines", lines_.place(), kMaxHeaderLines));
}

tl::expected<void, Error> RecordingReader::parse_column_names(std::string_view line) {
  const std::vector<std::string_view> names = split_cells(line, ",");
  const std::size_t sensor_count = count_sensors(names);
  const std::size_t expected_count = std::max(sensor_count, std::size_t{2});
  const std::vector<Column> columns = recording_columns(expected_count);
  for (const Column& column : columns) {
    const auto times = std::ranges::count(names, std::string_view(column.name));
    if (times != 1) {
      return failure(fmt::format("{}: column '{}' {}, expected {}; found '{}'", lines_.place(),
                                 column.name, times == 0 ? "is missing" : "stands there twice",
                                 recording_column_names(expected_count), excerpt(line)));
    }
  }
  for (const std::string_view name : names) {
    const auto known = std::ranges::find(columns, name, &Column::name);
    cells_.push_back(known == columns.end()
                         ? Cell{}
                         : Cell{.column = *known,
                                .known = true,
                                .largest = largest_number(*known, header_.acquisition)});
  }
  header_.acquisition.sensor_count = sensor_count;
  return {};
}

tl::expected<bool, Error> RecordingReader::read(Sample& sample) {
  events_.clear();
  while (true) {
    const auto outcome = lines_.next();
    if (!outcome) {
      return tl::unexpected(outcome.error());
    }
    if (*outcome == LineReader::Outcome::kEndOfFile) {
      return false;
    }
    if (*outcome == LineReader::Outcome::kCutShort) {
      complaints_.push_back(
          one_line(fmt::format("{}: the last line is cut short ('{}') and not used", lines_.place(),
                               excerpt(lines_.line()))));
      return false;
    }
    const std::string_view line = lines_.line();
    if (line.empty()) {
      continue;
    }
    if (line.starts_with('#')) {
      if (const auto kept = take_comment(line); !kept) {
        return tl::unexpected(kept.error());
      }
      continue;
    }
    if (const auto parsed = parse_row(line, sample); !parsed) {
      return tl::unexpected(parsed.error());
    }
    sample.flags |= std::exchange(restarted_, false) ? flag::kRestarted : 0;
    return true;
  }
}

tl::expected<void, Error> RecordingReader::take_comment(std::string_view line) {
  if (line.starts_with(kEventStart)) {
    if (auto event = parse_event(line)) {
      restarted_ = restarted_ || event->kind == event::kBoot;
      events_.push_back(std::move(*event));
    } else if (!std::exchange(complained_of_event_, true)) {
      complaints_.push_back(
          fmt::format("{}: {}; such lines are skipped", lines_.place(), event.error().message));
    }
    return {};
  }
  return line.starts_with(kJoinedStart) ? join(line) : tl::expected<void, Error>();
}

tl::expected<void, Error> RecordingReader::join(std::string_view line) {
  const std::string place = lines_.place();
  const RecordingHeader before = header_;
  cells_.clear();
  if (auto read = read_header(std::string(line.substr(1)) + '\n'); !read) {
    return read;
  }
  if (header_.acquisition != before.acquisition) {
    return failure(fmt::format(
        "{}: found another recording, sampled otherwise ({} sensors at {} Hz), expected "
        "{} sensors at {} Hz as before; replay it by itself",
        place, header_.acquisition.sensor_count, header_.acquisition.rate_hz,
        before.acquisition.sensor_count, before.acquisition.rate_hz));
  }
  restarted_ =
      restarted_ || (header_.boot_id && before.boot_id && header_.boot_id != before.boot_id);
  return {};
}

tl::expected<void, Error> RecordingReader::parse_row(std::string_view line, Sample& sample) const {
  sample = Sample{};
  const char* position = line.data();
  const char* const end = line.data() + line.size();
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    const Cell& cell = cells_[i];
    const ParsedCell parsed = parse_cell(position, end);
    if (cell.known && parsed.number && *parsed.number <= cell.largest) {
      store(cell.column, *parsed.number, sample);
    } else if (cell.known && is_reading(cell.column) && is_missing(parsed.text)) {
      sample.missing |= 1U << cell.column.sensor;
    } else if (cell.known) {
      return wrong_cell(cell, parsed.text);
    }
    position = parsed.text.data() + parsed.text.size();
    const bool last = i + 1 == cells_.size();
    if (last != (position == end)) {
      return failure(fmt::format("{}: found {} cells, expected {}: '{}'", lines_.place(),
                                 std::ranges::count(line, ',') + 1, cells_.size(), excerpt(line)));
    }
    ++position;
  }
  return {};
}

tl::unexpected<Error> RecordingReader::wrong_cell(const Cell& cell, std::string_view found) const {
  return failure(fmt::format("{}: field '{}': found '{}', expected a whole number from 0 to {}",
                             lines_.place(), cell.column.name, excerpt(found), cell.largest));
}

}  // namespace penduline
