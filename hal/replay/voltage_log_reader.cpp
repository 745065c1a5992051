// SPDX-License-Identifier: Apache-2.0
// Reading foreign logs of voltages.
#include "hal/replay/voltage_log_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "hal/replay/cells.hpp"
#include "hal/replay/recording_format.hpp"

namespace penduline {
namespace {

constexpr double kLargestVolts = 21.0;   // the largest whole volts that 32-bit counts of 10 nV hold
constexpr double kLargestTimeUs = 1e15;  // 31 years; fractions of a microsecond still count
constexpr std::string_view kSeparators = ",;\t";

std::optional<VoltageLogLayout::LogColumn> parse_column(std::string_view word) {
  using Kind = VoltageLogLayout::Kind;
  const std::string name(word);
  if (word == "-") {
    return {{.kind = Kind::kIgnored, .sensor = 0, .us_per_unit = 0, .name = name}};
  }
  if (word == "t_s" || word == "t_ms" || word == "t_us") {
    const double us_per_unit = word == "t_s" ? 1e6 : word == "t_ms" ? 1e3 : 1;
    return {{.kind = Kind::kTime, .sensor = 0, .us_per_unit = us_per_unit, .name = name}};
  }
  for (std::size_t sensor = 0; sensor < kMaxSensors; ++sensor) {
    if (word == sensor_prefix(sensor)) {
      return {{.kind = Kind::kVolts, .sensor = sensor, .us_per_unit = 0, .name = name}};
    }
  }
  return std::nullopt;
}

}  // namespace

tl::expected<VoltageLogLayout, Error> parse_log_layout(std::string_view text) {
  VoltageLogLayout layout;
  std::uint32_t sensors = 0;
  int times = 0;
  for (const std::string_view word : split_cells(text, ",")) {
    const auto column = parse_column(word);
    if (!column) {
      return failure(fmt::format(
          "found column '{}', expected t_s, t_ms, t_us, x, y, s3 to s{}, or -", word, kMaxSensors));
    }
    const std::uint32_t bit =
        column->kind == VoltageLogLayout::Kind::kVolts ? 1U << column->sensor : 0;
    times += column->kind == VoltageLogLayout::Kind::kTime ? 1 : 0;
    if ((sensors & bit) != 0 || times > 1) {
      return failure(fmt::format("column '{}' stands there twice in '{}'", word, text));
    }
    sensors |= bit;
    layout.columns.push_back(*column);
  }
  // Sensors count from x without a gap: the bits must be 11, 111, ...
  if (sensors < 3 || (sensors & (sensors + 1)) != 0) {
    return failure(
        fmt::format("found the columns '{}', expected at least x and y, then s3, s4, ...", text));
  }
  return layout;
}

tl::expected<VoltageLogReader, Error> VoltageLogReader::open(const std::string& path,
                                                             const VoltageLogLayout& layout) {
  auto lines = LineReader::open(path);
  if (!lines) {
    return tl::unexpected(lines.error());
  }
  VoltageLogReader reader(std::move(*lines), layout);
  if (const auto done = reader.look_ahead(); !done) {
    return tl::unexpected(done.error());
  }
  return reader;
}

tl::expected<void, Error> VoltageLogReader::look_ahead() {
  acquisition_ = {
      .rate_hz = layout_.rate_hz.value_or(0),
      .full_scale_counts = kImportCountsPerVolt,
      .reference_v = 1,
      .sensor_count = static_cast<std::size_t>(std::ranges::count(
          layout_.columns, VoltageLogLayout::Kind::kVolts, &VoltageLogLayout::LogColumn::kind))};
  const std::size_t wanted = layout_.rate_hz ? 1 : 2;
  while (ahead_.size() < wanted) {
    const auto row = next_row();
    if (!row) {
      return tl::unexpected(row.error());
    }
    if (!*row) {
      return failure(fmt::format("{}: found {} rows of numbers, expected at least {}",
                                 lines_.name(), ahead_.size(), wanted));
    }
    ahead_.insert(ahead_.begin(), **row);
  }
  if (layout_.rate_hz) {
    return {};
  }
  if (!ahead_.front().t_us) {
    return failure(
        fmt::format("{}: no column gives the time; say the rate with --rate", lines_.name()));
  }
  const double period_us = *ahead_.front().t_us - *ahead_.back().t_us;
  if (!(period_us > 0)) {
    return failure(fmt::format("{}: the time went from {} us to {} us, expected it to rise",
                               lines_.place(), *ahead_.back().t_us, *ahead_.front().t_us));
  }
  acquisition_.rate_hz = 1e6 / period_us;
  if (!(acquisition_.rate_hz >= kSlowestHz && acquisition_.rate_hz <= kFastestHz)) {
    return failure(
        fmt::format("{}: the first two rows are {} us apart, expected a rate from {} to {} Hz",
                    lines_.place(), period_us, kSlowestHz, kFastestHz));
  }
  return {};
}

tl::expected<std::optional<VoltageLogReader::Row>, Error> VoltageLogReader::next_row() {
  while (true) {
    const auto outcome = lines_.next();
    if (!outcome) {
      return tl::unexpected(outcome.error());
    }
    if (*outcome == LineReader::Outcome::kEndOfFile) {
      return std::nullopt;
    }
    const std::string_view line = lines_.line();
    if (trimmed(line).empty() || line.starts_with('#')) {
      continue;
    }
    if (std::exchange(first_line_, false) && is_line_of_names(line)) {
      continue;
    }
    auto row = parse_row(line);
    if (!row) {
      return tl::unexpected(row.error());
    }
    if (*outcome == LineReader::Outcome::kCutShort) {
      complaints_.push_back(one_line(
          fmt::format("{}: the last line ('{}') does not end; its last number may be cut short",
                      lines_.place(), excerpt(line))));
    }
    return *row;
  }
}

bool VoltageLogReader::is_line_of_names(std::string_view line) const {
  const std::vector<std::string_view> cells = split_cells(line, kSeparators);
  bool has_text = false;
  for (std::size_t i = 0; i < std::min(cells.size(), layout_.columns.size()); ++i) {
    const bool used = layout_.columns[i].kind != VoltageLogLayout::Kind::kIgnored;
    if (used && parse_number<double>(cells[i])) {
      return false;
    }
    has_text = has_text || (used && !is_missing(cells[i]));
  }
  return has_text;
}

tl::expected<VoltageLogReader::Row, Error> VoltageLogReader::parse_row(
    std::string_view line) const {
  const std::vector<std::string_view> cells = split_cells(line, kSeparators);
  if (cells.size() != layout_.columns.size()) {
    return failure(fmt::format("{}: found {} cells, expected {} as --import says", lines_.place(),
                               cells.size(), layout_.columns.size()));
  }
  Row row;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const VoltageLogLayout::LogColumn& column = layout_.columns[i];
    const bool volts = column.kind == VoltageLogLayout::Kind::kVolts;
    if (column.kind == VoltageLogLayout::Kind::kIgnored) {
      continue;
    }
    if (volts && is_missing(cells[i])) {
      row.sample.missing |= 1U << column.sensor;
      continue;
    }
    const auto number = parse_number<double>(cells[i]);
    const double largest = volts ? kLargestVolts : kLargestTimeUs / column.us_per_unit;
    if (!number || !(std::abs(*number) <= largest)) {
      return failure(fmt::format("{}: field '{}': found '{}', expected a number from {} to {}",
                                 lines_.place(), column.name, excerpt(cells[i]), -largest,
                                 largest));
    }
    if (volts) {
      row.sample.readings[column.sensor].on =
          static_cast<std::int32_t>(std::lround(*number * kImportCountsPerVolt));
    } else {
      row.t_us = *number * column.us_per_unit;
    }
  }
  return row;
}

tl::expected<bool, Error> VoltageLogReader::read(Sample& sample) {
  Row row;
  if (!ahead_.empty()) {
    row = ahead_.back();
    ahead_.pop_back();
  } else {
    const auto next = next_row();
    if (!next) {
      return tl::unexpected(next.error());
    }
    if (!*next) {
      return false;
    }
    row = **next;
  }
  const double period_us = 1e6 / acquisition_.rate_hz;
  sample = row.sample;
  if (last_) {
    const double t_us = row.t_us.value_or(last_->t_us + period_us);
    const double periods = std::round((t_us - last_->t_us) / period_us);
    last_ = {.t_us = t_us, .seq = last_->seq + static_cast<std::uint64_t>(std::max(1.0, periods))};
  } else {
    last_ = {.t_us = row.t_us.value_or(0), .seq = 0};
  }
  sample.t_us = std::llround(last_->t_us);
  sample.seq = last_->seq;
  return true;
}

}  // namespace penduline
