// SPDX-License-Identifier: Apache-2.0
// Reads a foreign log, plain columns of voltages with or without times, as a stream of samples.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <vector>

#include "common/sample.hpp"
#include "hal/replay/line_reader.hpp"
#include "hal/sample_source.hpp"

namespace penduline {

/// How a foreign log is laid out.
struct VoltageLogLayout {
  enum class Kind { kVolts, kTime, kIgnored };
  struct LogColumn {
    Kind kind;
    std::size_t sensor;  ///< of kVolts
    double us_per_unit;  ///< of kTime
    std::string name;
  };
  std::vector<LogColumn> columns;
  /// Needed where no column gives the time; else it says which times are dropouts, and by default
  /// comes from the first two rows.
  std::optional<double> rate_hz;
};

/// Reads a layout such as "t_s,x,y" or "x,y,-": `t_s`, `t_ms`, `t_us` a time, `x`, `y`, `s3`, ...
/// the volts of a sensor, `-` a column to skip. Fails on anything else and on fewer than two
/// sensors.
[[nodiscard]] tl::expected<VoltageLogLayout, Error> parse_log_layout(std::string_view text);

/// Imported volts are kept as whole counts of 10 nV, so that they go the way of all samples.
inline constexpr double kImportCountsPerVolt = 1e8;

/// A foreign log as a SampleSource, in constant memory. Cells are separated by commas, semicolons
/// or tabs; a first line of names is skipped. The volts count as the signal: what to subtract for
/// ambient light is not in such a log.
class VoltageLogReader {
 public:
  static tl::expected<VoltageLogReader, Error> open(const std::string& path,
                                                    const VoltageLogLayout& layout);

  [[nodiscard]] const Acquisition<double>& acquisition() const { return acquisition_; }

  /// The next row; `seq` counts sample periods, so that a jump of the times is a dropout. An empty
  /// or `nan` voltage is a missing reading; anything else that is not a number fails.
  tl::expected<bool, Error> read(Sample& sample);

  [[nodiscard]] std::string place() const { return lines_.place(); }
  [[nodiscard]] double progress() const { return lines_.progress(); }
  /// What is doubtful in the file and cost no sample, in words; grows while reading.
  [[nodiscard]] const std::vector<std::string>& complaints() const { return complaints_; }

 private:
  struct Row {
    std::optional<double> t_us;
    Sample sample;
  };

  VoltageLogReader(LineReader lines, VoltageLogLayout layout)
      : lines_(std::move(lines)), layout_(std::move(layout)) {}
  tl::expected<void, Error> look_ahead();
  tl::expected<std::optional<Row>, Error> next_row();
  [[nodiscard]] bool is_line_of_names(std::string_view line) const;
  tl::expected<Row, Error> parse_row(std::string_view line) const;

  LineReader lines_;
  VoltageLogLayout layout_;
  Acquisition<double> acquisition_;
  std::vector<Row> ahead_;  ///< rows read to learn the rate, not yet handed out; newest first
  /// Where the row handed out last stands.
  struct Place {
    double t_us;
    std::uint64_t seq;
  };
  std::optional<Place> last_;
  std::vector<std::string> complaints_;
  bool first_line_ = true;  ///< the next line that is no comment is the first
};

static_assert(SampleSource<VoltageLogReader>);

}  // namespace penduline
