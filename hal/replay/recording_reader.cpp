// SPDX-License-Identifier: Apache-2.0
// Reading recordings: the header by toml++, the rows by hand because there are millions of them.
#include "hal/replay/recording_reader.hpp"

#include <fmt/format.h>

#include <toml++/toml.h>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <sstream>
#include <utility>

#include "hal/replay/cells.hpp"
#include "hal/replay/toml_text.hpp"

namespace penduline {
namespace {

constexpr std::size_t kMaxHeaderLines = 1000;
constexpr double kLeastReferenceV = 1e-6;
constexpr double kMostReferenceV = 1e6;
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

tl::expected<void, Error> RecordingReader::read_header() {
  std::string header;
  for (std::size_t count = 0; count < kMaxHeaderLines; ++count) {
    const auto outcome = lines_.next();
    if (!outcome) {
      return tl::unexpected(outcome.error());
    }
    if (*outcome == LineReader::Outcome::kEndOfFile) {
      return count == 0 ? failure(fmt::format("{}: the file is empty, expected a recording that "
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
    if (auto parsed = parse_header(header); !parsed) {
      return parsed;
    }
    return parse_column_names(line);
  }
  return failure(
      fmt::format("{}: the header has more than {} lines", lines_.place(), kMaxHeaderLines));
}

tl::expected<void, Error> RecordingReader::parse_header(const std::string& header) {
  if (header.find_first_not_of('\n') == std::string::npos) {
    return failure(
        fmt::format("{}: found '{}', expected a recording that begins with '# {} = {}' "
                    "(plain logs of voltages are read with --import)",
                    lines_.place(), excerpt(lines_.line()), kVersionKey, kRecordingVersion));
  }
  toml::table table;
  try {
    table = toml::parse(header);
  } catch (const toml::parse_error& error) {
    return failure(fmt::format("{}:{}: the header is not TOML behind '# ': {}", lines_.name(),
                               error.source().begin.line, error.description()));
  }
  const auto wrong = [&](std::string_view key, std::string_view expected) {
    const toml::node* found = table.get(key);
    return failure(
        found == nullptr
            ? fmt::format("{}: header key '{}': missing, expected {}", lines_.name(), key, expected)
            : fmt::format("{}:{}: header key '{}': found {}, expected {}", lines_.name(),
                          found->source().begin.line, key, toml_text(*found), expected));
  };
  const auto within = [&](std::string_view key, double least, double most) {
    const auto value = table[key].value<double>();
    return value && *value >= least && *value <= most ? value : std::nullopt;
  };

  const auto version = table[kVersionKey].value_exact<std::int64_t>();
  if (version != kRecordingVersion) {
    return wrong(kVersionKey, fmt::format("{}", kRecordingVersion));
  }
  const auto rate_hz = within("rate_hz", kSlowestHz, kFastestHz);
  if (!rate_hz) {
    return wrong("rate_hz", fmt::format("a rate from {} to {}", kSlowestHz, kFastestHz));
  }
  const auto full_scale_counts =
      within("full_scale_counts", 1, std::numeric_limits<std::int32_t>::max());
  if (!full_scale_counts || *full_scale_counts != std::floor(*full_scale_counts)) {
    return wrong("full_scale_counts", "the counts at full scale, a whole number such as 65535");
  }
  const auto reference_v = within("reference_v", kLeastReferenceV, kMostReferenceV);
  if (!reference_v) {
    return wrong("reference_v",
                 fmt::format("a voltage from {} to {}", kLeastReferenceV, kMostReferenceV));
  }
  header_.acquisition = {
      .rate_hz = *rate_hz, .full_scale_counts = *full_scale_counts, .reference_v = *reference_v};
  header_.board = table["board"].value_or(std::string());
  header_.firmware = table["firmware"].value_or(std::string());
  if (const auto started = table["started"].value<toml::date_time>()) {
    std::ostringstream text;
    text << *started;
    header_.started = text.str();
  }
  return {};
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
    if (line.empty() || line.starts_with('#')) {
      continue;
    }
    if (const auto parsed = parse_row(line, sample); !parsed) {
      return tl::unexpected(parsed.error());
    }
    return true;
  }
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
