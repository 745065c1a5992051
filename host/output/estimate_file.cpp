// SPDX-License-Identifier: Apache-2.0
// Estimates to a file, in large pieces.
#include "host/output/estimate_file.hpp"

#include <utility>

namespace penduline {

EstimateFile::EstimateFile(TextFile file, EstimateLayout layout)
    : file_(std::move(file)), layout_(layout) {
  append_estimate_head(file_.text(), layout_);
}

tl::expected<void, Error> EstimateFile::take(const Estimate<double>& estimate) {
  append_estimate_row(file_.text(), estimate, layout_);
  return file_.flush_if_large();
}

}  // namespace penduline
