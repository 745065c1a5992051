// SPDX-License-Identifier: Apache-2.0
// What the tests of recordings share: design.md's example, and reading a text as a recording.
#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/sample.hpp"
#include "hal/error.hpp"
#include "hal/replay/recording_reader.hpp"
#include "tests/unit/temporary_folder.hpp"

namespace penduline::test {

/// design.md's example, its header and its column names: lines 1 to 8 of a file.
inline constexpr std::string_view kDesignHeader =
    "# penduline_recording = 1\n"
    "# rate_hz = 20.0\n"
    "# full_scale_counts = 65535\n"
    "# reference_v = 3.3\n"
    "# board = \"pico\"\n"
    "# firmware = \"0.1.0\"\n"
    "# started = 2026-11-21T07:00:00Z\n";
inline constexpr std::string_view kDesignColumns = "seq,t_us,x_on,x_off,y_on,y_off,flags\n";

/// A recording with the design's header and columns; its first row is line 9.
[[nodiscard]] inline std::string recording(std::string_view rows) {
  return fmt::format("{}{}{}", kDesignHeader, kDesignColumns, rows);
}

/// A sample as text, so that a failed comparison can be read: "seq t_us on/off on/off flags", "-"
/// for a missing reading.
[[nodiscard]] inline std::string shown(const Sample& sample, std::size_t sensor_count) {
  std::string text = fmt::format("{} {}", sample.seq, sample.t_us);
  for (std::size_t i = 0; i < sensor_count; ++i) {
    const Reading& reading = sample.readings[i];
    text += sample.has_reading(i) ? fmt::format(" {}/{}", reading.on, reading.off) : " -";
  }
  return text + fmt::format(" {}", sample.flags);
}

/// What reading something to its end gave.
struct ReadOut {
  std::vector<std::string> rows;  ///< as `shown` has them
  std::string error;              ///< "" where there was none
  std::vector<std::string> complaints;
  RecordingHeader header;
  /// "SEQ: EVENT" of each event, SEQ being the row that follows, "end" behind the last one.
  std::vector<std::string> events;
};

[[nodiscard]] inline ReadOut read_out(const std::string& path) {
  ReadOut out;
  auto reader = RecordingReader::open(path);
  if (!reader) {
    out.error = reader.error().message;
    return out;
  }
  out.header = reader->header();
  while (true) {
    Sample sample;
    const auto more = reader->read(sample);
    for (const RecordingEvent& event : reader->events()) {
      out.events.push_back((more && *more ? fmt::format("{}: ", sample.seq) : "end: ") +
                           event_line(event));
    }
    if (!more) {
      out.error = more.error().message;
      break;
    }
    if (!*more) {
      break;
    }
    out.rows.push_back(shown(sample, out.header.acquisition.sensor_count));
  }
  out.complaints = reader->complaints();
  return out;
}

/// Reads a text as the file `rec.csv` of the working directory.
[[nodiscard]] inline ReadOut read_text(std::string_view text) {
  const TemporaryFolder folder;
  ReadOut out = read_out(folder.write("rec.csv", text));
  out.error = folder.relative(out.error);
  for (std::string& complaint : out.complaints) {
    complaint = folder.relative(complaint);
  }
  return out;
}

}  // namespace penduline::test
