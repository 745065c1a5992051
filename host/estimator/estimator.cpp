// SPDX-License-Identifier: Apache-2.0
// The streaming estimator `gn`, and the choice between estimators.
#include "host/estimator/estimator.hpp"

#include <fmt/format.h>

#include "common/pipeline.hpp"
#include "host/estimator/paper_estimator.hpp"

namespace penduline {
namespace {

/// The pipeline of `common`, as it runs on the board.
class GaussNewtonEstimator final : public Estimator {
 public:
  GaussNewtonEstimator(const Rig<double>& rig, const Acquisition<double>& acquisition)
      : pipeline_(rig, acquisition) {}

  tl::expected<void, Error> take(const Sample& sample, EstimateSink& sink) override {
    return sink.take(pipeline_.update(sample));
  }

  tl::expected<void, Error> finish(EstimateSink& /*sink*/) override { return {}; }

 private:
  Pipeline<double> pipeline_;
};

}  // namespace

tl::expected<std::unique_ptr<Estimator>, Error> make_estimator(
    const EstimatorOptions& options, const Rig<double>& rig,
    const Acquisition<double>& acquisition) {
  if (rig.layout.count != acquisition.sensor_count) {
    return failure(fmt::format("the rig has {} sensors, the samples have {}", rig.layout.count,
                               acquisition.sensor_count));
  }
  if (options.kind == EstimatorKind::kPaper) {
    return PaperEstimator::make(rig, acquisition, options.align);
  }
  return std::make_unique<GaussNewtonEstimator>(rig, acquisition);
}

}  // namespace penduline
