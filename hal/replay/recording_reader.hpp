// SPDX-License-Identifier: Apache-2.0
// Reads a recording as a stream of samples.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <vector>

#include "common/sample.hpp"
#include "hal/replay/line_reader.hpp"
#include "hal/replay/recording_event.hpp"
#include "hal/replay/recording_format.hpp"
#include "hal/sample_source.hpp"

namespace penduline {

/// A recording as a SampleSource, in constant memory.
class RecordingReader {
 public:
  /// Opens a recording ("-": standard input) and reads its header. The error names file and line,
  /// what was found there and what was expected.
  static tl::expected<RecordingReader, Error> open(const std::string& path);

  [[nodiscard]] const Acquisition<double>& acquisition() const { return header_.acquisition; }
  [[nodiscard]] const RecordingHeader& header() const { return header_; }

  /// The next row. An empty or `nan` reading is a missing one; anything else that is not a row of
  /// numbers fails, naming line and field. The first row after a `boot` event is `restarted`.
  /// Another recording that was joined to this one goes on where it ends, if it is sampled alike.
  tl::expected<bool, Error> read(Sample& sample);

  /// The events between the row read last and the one before; at the end, those behind the last
  /// row.
  [[nodiscard]] const std::vector<RecordingEvent>& events() const { return events_; }

  /// "FILE:LINE" of the row read last.
  [[nodiscard]] std::string place() const { return lines_.place(); }
  [[nodiscard]] double progress() const { return lines_.progress(); }
  /// What is wrong with the file and cost no sample of it, in words; grows while reading.
  [[nodiscard]] const std::vector<std::string>& complaints() const { return complaints_; }

 private:
  /// What one cell of a row is for: a known column, or one to be skipped.
  struct Cell {
    Column column{};
    bool known = false;
    std::uint64_t largest = 0;  ///< number that it may hold
  };

  explicit RecordingReader(LineReader lines) : lines_(std::move(lines)) {}
  /// Reads up to the column names; `header` is what of it has been read.
  tl::expected<void, Error> read_header(std::string header = "");
  tl::expected<void, Error> parse_column_names(std::string_view line);
  tl::expected<void, Error> parse_row(std::string_view line, Sample& sample) const;
  tl::expected<void, Error> take_comment(std::string_view line);
  /// Goes on with the recording whose header begins with `line`.
  tl::expected<void, Error> join(std::string_view line);
  [[nodiscard]] tl::unexpected<Error> wrong_cell(const Cell& cell, std::string_view found) const;

  LineReader lines_;
  RecordingHeader header_;
  std::vector<Cell> cells_;
  std::vector<RecordingEvent> events_;
  bool restarted_ = false;  ///< the next row is the first since the device started
  bool complained_of_event_ = false;
  std::vector<std::string> complaints_;
};

static_assert(SampleSource<RecordingReader>);

}  // namespace penduline
