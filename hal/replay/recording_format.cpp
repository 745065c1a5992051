// SPDX-License-Identifier: Apache-2.0
// Writing recordings.
#include "hal/replay/recording_format.hpp"

#include <fmt/format.h>

#include <iterator>

#include "hal/replay/toml_text.hpp"

namespace penduline {
namespace {

/// A header value as TOML; empty where the header does not know it.
std::string header_value(const RecordingHeader& header, std::string_view key) {
  const auto quoted = [](const std::string& text) { return text.empty() ? "" : toml_quoted(text); };
  const auto number = [](double value) { return toml_text(toml::value<double>(value)); };
  if (key == kVersionKey) {
    return fmt::format("{}", kRecordingVersion);
  }
  if (key == "rate_hz") {
    return number(header.acquisition.rate_hz);
  }
  if (key == "full_scale_counts") {
    return fmt::format("{:.0f}", header.acquisition.full_scale_counts);
  }
  if (key == "reference_v") {
    return number(header.acquisition.reference_v);
  }
  if (key == "board") {
    return quoted(header.board);
  }
  if (key == "firmware") {
    return quoted(header.firmware);
  }
  if (key == "serial") {
    return quoted(header.serial);
  }
  if (key == "boot_id") {
    return header.boot_id ? fmt::format("{}", *header.boot_id) : "";
  }
  return header.started;
}

}  // namespace

std::string sensor_prefix(std::size_t sensor) {
  switch (sensor) {
    case 0:
      return "x";
    case 1:
      return "y";
    default:
      return fmt::format("s{}", sensor + 1);
  }
}

std::vector<Column> recording_columns(std::size_t sensor_count) {
  std::vector<Column> columns{{"seq", Field::kSeq, 0}, {"t_us", Field::kTime, 0}};
  for (std::size_t i = 0; i < sensor_count; ++i) {
    columns.push_back({sensor_prefix(i) + "_on", Field::kOn, i});
    columns.push_back({sensor_prefix(i) + "_off", Field::kOff, i});
  }
  columns.push_back({"flags", Field::kFlags, 0});
  return columns;
}

std::string recording_column_names(std::size_t sensor_count) {
  std::string text;
  std::string_view separator;
  for (const Column& column : recording_columns(sensor_count)) {
    text += separator;
    text += column.name;
    separator = ",";
  }
  return text;
}

std::string recording_head(const RecordingHeader& header) {
  std::string text;
  for (const HeaderKeyDescription& key : kHeaderKeys) {
    const std::string value = header_value(header, key.key);
    if (!value.empty()) {
      text += fmt::format("# {} = {}\n", key.key, value);
    }
  }
  text += recording_column_names(header.acquisition.sensor_count);
  text += '\n';
  return text;
}

void append_recording_row(std::string& text, const Sample& sample, std::size_t sensor_count) {
  auto out = std::back_inserter(text);
  fmt::format_to(out, "{},{},", sample.seq, sample.t_us);
  for (std::size_t i = 0; i < sensor_count; ++i) {
    if (sample.has_reading(i)) {
      fmt::format_to(out, "{},{},", sample.readings[i].on, sample.readings[i].off);
    } else {
      text += ",,";
    }
  }
  fmt::format_to(out, "{}\n", sample.flags);
}

}  // namespace penduline
