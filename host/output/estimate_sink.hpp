// SPDX-License-Identifier: Apache-2.0
// What takes estimates: an output, a summary.
#pragma once

#include <tl/expected.hpp>

#include "common/estimate.hpp"
#include "hal/error.hpp"

namespace penduline {

class EstimateSink {
 public:
  EstimateSink() = default;
  EstimateSink(const EstimateSink&) = delete;
  EstimateSink& operator=(const EstimateSink&) = delete;
  virtual ~EstimateSink() = default;

  /// Takes the next estimate; fails where it cannot be written.
  virtual tl::expected<void, Error> take(const Estimate<double>& estimate) = 0;
};

}  // namespace penduline
