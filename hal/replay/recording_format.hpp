// SPDX-License-Identifier: Apache-2.0
// The recording format: one list of header keys and columns for writer, reader and docs/formats.md.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/sample.hpp"

namespace penduline {

/// What a recording says before its first sample.
struct RecordingHeader {
  Acquisition<double> acquisition;
  std::string board;     ///< "" where unknown
  std::string firmware;  ///< "" where unknown
  std::string started;   ///< RFC 3339 in UTC; "" where unknown or simulated
  std::string serial{};  ///< the board's own number in hexadecimal; "" where unknown
  std::optional<std::uint32_t> boot_id{};
};

inline constexpr std::string_view kVersionKey = "penduline_recording";
inline constexpr int kRecordingVersion = 1;

/// Sample rates that a stream may have.
inline constexpr double kSlowestHz = 1e-3;
inline constexpr double kFastestHz = 1e6;

struct HeaderKeyDescription {
  std::string_view key;
  bool required;
  std::string_view meaning;
};

/// Every header key, in the order in which the writer puts them.
inline constexpr std::array kHeaderKeys = {
    HeaderKeyDescription{kVersionKey, true, "version of the format, 1"},
    HeaderKeyDescription{"rate_hz", true, "nominal sample rate"},
    HeaderKeyDescription{"full_scale_counts", true, "counts at the reference voltage"},
    HeaderKeyDescription{"reference_v", true, "the ADC's reference voltage"},
    HeaderKeyDescription{"board", false, "name of the board"},
    HeaderKeyDescription{"firmware", false, "version of the firmware"},
    HeaderKeyDescription{"started", false, "host time at which the file began, UTC"},
    HeaderKeyDescription{"serial", false, "the board's own number"},
    HeaderKeyDescription{"boot_id", false, "another number after every start of the board"},
};

/// What a column holds.
enum class Field { kSeq, kTime, kOn, kOff, kFlags };

struct Column {
  std::string name;
  Field field = Field::kSeq;
  std::size_t sensor = 0;  ///< of kOn and kOff
};

/// The columns for a number of sensors, in the order in which the writer puts them:
/// seq,t_us,x_on,x_off,y_on,y_off,s3_on,s3_off,...,flags.
[[nodiscard]] std::vector<Column> recording_columns(std::size_t sensor_count);

/// What the columns of a sensor begin with: "x", "y", "s3", ...
[[nodiscard]] std::string sensor_prefix(std::size_t sensor);

/// The names of the columns, with commas between them.
[[nodiscard]] std::string recording_column_names(std::size_t sensor_count);

/// The header and the line of column names, each line ended.
[[nodiscard]] std::string recording_head(const RecordingHeader& header);

/// Appends one sample as a line.
void append_recording_row(std::string& text, const Sample& sample, std::size_t sensor_count);

}  // namespace penduline
