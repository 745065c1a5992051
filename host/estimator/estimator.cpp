// SPDX-License-Identifier: Apache-2.0
// The streaming estimators, and the choice between estimators.
#include "host/estimator/estimator.hpp"

#include <fmt/format.h>

#include "common/pipeline.hpp"
#include "common/swing_tracker.hpp"
#include "host/estimator/paper_estimator.hpp"
#include "host/estimator/smoother.hpp"

namespace penduline {
namespace {

/// One that answers each sample at once: `Pipeline` or `SwingTracker`, as on the board.
template <class Core>
class StreamingEstimator final : public Estimator {
 public:
  StreamingEstimator(const Rig<double>& rig, const Acquisition<double>& acquisition)
      : core_(rig, acquisition) {}

  tl::expected<void, Error> take(const Sample& sample, EstimateSink& sink) override {
    return sink.take(core_.update(sample));
  }

  tl::expected<void, Error> finish(EstimateSink& /*sink*/) override { return {}; }

 private:
  Core core_;
};

}  // namespace

tl::expected<std::unique_ptr<Estimator>, Error> make_estimator(
    const EstimatorOptions& options, const Rig<double>& rig,
    const Acquisition<double>& acquisition) {
  if (rig.layout.count != acquisition.sensor_count) {
    return failure(fmt::format("the rig has {} sensors, the samples have {}", rig.layout.count,
                               acquisition.sensor_count));
  }
  switch (options.kind) {
    case EstimatorKind::kPaper:
      return PaperEstimator::make(rig, acquisition, options.align);
    case EstimatorKind::kGaussNewton:
      break;
    case EstimatorKind::kKalman:
      return std::make_unique<StreamingEstimator<SwingTracker<double>>>(rig, acquisition);
    case EstimatorKind::kSmoother:
      return std::make_unique<Smoother>(rig, acquisition);
  }
  return std::make_unique<StreamingEstimator<Pipeline<double>>>(rig, acquisition);
}

}  // namespace penduline
