// SPDX-License-Identifier: Apache-2.0
// Forwards with the filter, backwards through its steps.
#include "host/estimator/smoother.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <utility>

#include "common/swing_estimate.hpp"

namespace penduline {

/// Notes the gaps, and the filter between prediction and them.
class Smoother::Witness {
 public:
  explicit Witness(Step& step) : step_(step) {}

  void measured(const GapMeasurements<double>& gaps) { step_.measured = gaps; }

  void predicted(const SwingFilter<double>::Transition& transition,
                 const SwingFilter<double>& filter) {
    step_.predicted = belief_of(filter);
    const Eigen::Index states = step_.predicted.state.size();
    step_.transition = Eigen::MatrixXd::Identity(states, states);
    for (std::size_t i = 0; i < transition.size(); ++i) {
      for (std::size_t j = 0; j < transition[i].size(); ++j) {
        step_.transition(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
            transition[i][j];
      }
    }
  }

 private:
  Step& step_;
};

Smoother::Smoother(const Rig<double>& rig, const Acquisition<double>& acquisition)
    : rig_(rig), tracker_(rig, acquisition) {}

tl::expected<void, Error> Smoother::take(const Sample& sample, EstimateSink& sink) {
  Step step;
  step.estimate = tracker_.update(sample, Witness(step));
  const bool follows = step.transition.size() > 0 && step.estimate.attitude;
  if (!follows) {
    if (auto taken = finish(sink); !taken) {
      return taken;
    }
  }
  if (!step.estimate.attitude) {
    return sink.take(step.estimate);
  }
  step.filtered = belief_of(tracker_.filter());
  steps_.push_back(std::move(step));
  if (sample.t_us - steps_.front().estimate.t_us >= 2 * kAheadUs) {
    const auto kept = std::ranges::lower_bound(steps_, sample.t_us - kAheadUs, {},
                                               [](const Step& past) { return past.estimate.t_us; });
    return hand_on(static_cast<std::size_t>(kept - steps_.begin()), sink);
  }
  return steps_.size() < kMostSteps ? tl::expected<void, Error>() : hand_on(kMostSteps / 2, sink);
}

tl::expected<void, Error> Smoother::finish(EstimateSink& sink) {
  return hand_on(steps_.size(), sink);
}

Smoother::Belief Smoother::belief_of(const SwingFilter<double>& filter) {
  const auto states = static_cast<Eigen::Index>(filter.states());
  Belief belief{.state = Eigen::Map<const Eigen::VectorXd>(filter.state().data(), states),
                .covariance = Eigen::MatrixXd(states, states)};
  for (Eigen::Index i = 0; i < states; ++i) {
    for (Eigen::Index j = 0; j < states; ++j) {
      belief.covariance(i, j) =
          filter.covariance(static_cast<std::size_t>(i), static_cast<std::size_t>(j));
    }
  }
  return belief;
}

/// Whether it is better than the filter's own: rounding may have broken what was ill-conditioned.
bool Smoother::is_sound(const Belief& belief) {
  return belief.state.allFinite() && belief.covariance.allFinite() &&
         belief.covariance.diagonal().minCoeff() >= 0;
}

Smoother::Belief Smoother::smoothed_before(const Step& step, const Step& later,
                                           const Belief& smoothed) {
  // In units of each state's own sigma, so that metres and radians are alike. What is known for
  // certain has none, and learns nothing.
  const Eigen::MatrixXd& predicted = later.predicted.covariance;
  const Eigen::VectorXd unit = predicted.diagonal().unaryExpr(
      [](double variance) { return variance > 0 ? 1 / std::sqrt(variance) : 0; });
  Eigen::MatrixXd scaled = unit.asDiagonal() * predicted * unit.asDiagonal();
  scaled.diagonal().setOnes();
  const Eigen::MatrixXd across = unit.asDiagonal() * later.transition * step.filtered.covariance;
  const Eigen::MatrixXd gain = (unit.asDiagonal() * scaled.ldlt().solve(across)).transpose();
  return {.state = step.filtered.state + gain * (smoothed.state - later.predicted.state),
          .covariance = step.filtered.covariance +
                        gain * (smoothed.covariance - predicted) * gain.transpose()};
}

tl::expected<void, Error> Smoother::hand_on(std::size_t count, EstimateSink& sink) {
  Belief belief;
  for (std::size_t i = steps_.size(); i-- > 0;) {
    Step& step = steps_[i];
    belief = i + 1 == steps_.size() ? step.filtered : smoothed_before(step, steps_[i + 1], belief);
    if (i < count && is_sound(belief)) {
      SwingFilter<double>::State state{};
      Eigen::Map<Eigen::VectorXd>(state.data(), belief.state.size()) = belief.state;
      put_state(rig_, state, {.first = belief.covariance(0, 0), .second = belief.covariance(1, 1)},
                step.measured, step.estimate);
    }
  }
  for (; count > 0; --count) {
    if (auto taken = sink.take(steps_.front().estimate); !taken) {
      return taken;
    }
    steps_.pop_front();
  }
  return {};
}

}  // namespace penduline
