// SPDX-License-Identifier: Apache-2.0
// Writes queued estimates as lines to a file, a pipe or a terminal that may stall.
#pragma once

#include <cstdint>
#include <string>

#include "host/output/estimate_writer.hpp"
#include "host/output/queued_output.hpp"
#include "host/output/text_file.hpp"

namespace penduline {

class LineWriter final : public QueueWriter {
 public:
  /// With `ends_with_reader` the program ends where the reader of its standard output has gone, by
  /// SIGPIPE, as others in a pipeline do, unless that is ignored (as under systemd).
  LineWriter(TextFile file, EstimateLayout layout, bool ends_with_reader);

  [[nodiscard]] std::string name() const override { return file_.name(); }
  /// Fails where the reader is gone or the file cannot be written.
  tl::expected<void, Error> run(EstimateQueue& queue) override;

 private:
  void fill(EstimateQueue& queue);

  TextFile file_;
  EstimateLayout layout_;
  bool ends_with_reader_;
  std::uint64_t rows_ = 0;  ///< in the file's text
  std::string next_row_;    ///< what did not fit into that
};

}  // namespace penduline
