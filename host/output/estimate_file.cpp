// SPDX-License-Identifier: Apache-2.0
// Estimates to a file, in large pieces.
#include "host/output/estimate_file.hpp"

#include <utility>

namespace penduline {

EstimateFile::EstimateFile(TextFile file, EstimateFormat format)
    : file_(std::move(file)), format_(format) {
  append_estimate_head(file_.text(), format_);
}

tl::expected<void, Error> EstimateFile::take(const Estimate<double>& estimate) {
  append_estimate_row(file_.text(), estimate, format_);
  return file_.flush_if_large();
}

}  // namespace penduline
