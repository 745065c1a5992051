// SPDX-License-Identifier: Apache-2.0
// Estimators: what turns samples into estimates, chosen by name.
#pragma once

#include <memory>
#include <string_view>
#include <tl/expected.hpp>

#include "common/rig.hpp"
#include "common/sample.hpp"
#include "hal/error.hpp"
#include "host/output/estimate_sink.hpp"

namespace penduline {

class Estimator {
 public:
  Estimator() = default;
  Estimator(const Estimator&) = delete;
  Estimator& operator=(const Estimator&) = delete;
  virtual ~Estimator() = default;

  /// Takes the next sample. A streaming estimator hands its estimate on at once.
  virtual tl::expected<void, Error> take(const Sample& sample, EstimateSink& sink) = 0;

  /// Ends the stream. An offline estimator hands its last estimates on here; there is one a sample.
  virtual tl::expected<void, Error> finish(EstimateSink& sink) = 0;
};

enum class EstimatorKind { kPaper, kGaussNewton, kKalman, kSmoother };

/// What the command line calls it.
[[nodiscard]] constexpr std::string_view estimator_name(EstimatorKind kind) {
  switch (kind) {
    case EstimatorKind::kPaper:
      return "paper";
    case EstimatorKind::kGaussNewton:
      return "gn";
    case EstimatorKind::kKalman:
      return "ekf";
    case EstimatorKind::kSmoother:
      break;
  }
  return "smoother";
}

/// Whether its estimates come long after their samples, many at once.
[[nodiscard]] constexpr bool is_offline(EstimatorKind kind) {
  return kind == EstimatorKind::kPaper || kind == EstimatorKind::kSmoother;
}

struct EstimatorOptions {
  EstimatorKind kind = EstimatorKind::kGaussNewton;
  bool align = false;  ///< `paper`: take the filter's delay out of the rows' times
};

/// Makes an estimator for a stream. Fails where the rig does not suit it, naming what does not.
[[nodiscard]] tl::expected<std::unique_ptr<Estimator>, Error> make_estimator(
    const EstimatorOptions& options, const Rig<double>& rig,
    const Acquisition<double>& acquisition);

}  // namespace penduline
