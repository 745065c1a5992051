// SPDX-License-Identifier: Apache-2.0
// The angles that the board itself finds, and the rig that it needs for them: uploaded, stored,
// used by the estimator that it names.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>
#include <variant>

#include "common/estimate.hpp"
#include "common/pipeline.hpp"
#include "common/swing_tracker.hpp"
#include "common/wire/commands.hpp"
#include "common/wire/rig_image.hpp"
#include "firmware/rig_store.hpp"
#include "firmware/rig_upload.hpp"
#include "firmware/window_sample.hpp"
#include "hal/concepts.hpp"

namespace penduline {

template <FirmwareBoard Board>
class OnboardEstimate {
 public:
  using BoardStore = std::remove_cvref_t<decltype(std::declval<Board&>().store())>;

  explicit OnboardEstimate(BoardStore& store) : store_(store) {}

  /// Reads the store anew. `rate_millihz` is the rate of the samples to come, on which the filter
  /// depends; the Kalman filter has no time for its work where it is above
  /// wire::kMostKalmanMillihz.
  void use_stored_rig(std::uint32_t rate_millihz) {
    rate_millihz_ = rate_millihz;
    const StoredRig stored = read_rig(store_.contents());
    state_ = stored.state == wire::StoreState::kValid && !suits(stored.rig)
                 ? wire::StoreState::kDamaged
                 : stored.state;
    estimator_ = std::monostate();
    if (state_ != wire::StoreState::kValid) {
      return;
    }
    const Acquisition<float> acquisition{
        .rate_hz = static_cast<float>(rate_millihz) / 1000,
        .full_scale_counts = kFullScaleCounts,
        .reference_v = static_cast<float>(Board::kReferenceUv) / 1e6F,
        .sensor_count = kChannels};
    if (stored.rig->estimator == wire::OnboardEstimator::kGaussNewton) {
      estimator_.template emplace<Pipeline<float>>(stored.rig->rig, acquisition);
    } else if (rate_millihz <= wire::kMostKalmanMillihz) {
      estimator_.template emplace<SwingTracker<float>>(stored.rig->rig, acquisition);
    }
  }

  [[nodiscard]] wire::StoreState store_state() const { return state_; }

  /// The estimate of a sample; none without an estimator that has a rig and the time.
  [[nodiscard]] std::optional<Estimate<float>> estimate(const Sample& sample) {
    if (auto* pipeline = std::get_if<Pipeline<float>>(&estimator_)) {
      return pipeline->update(sample);
    }
    if (auto* tracker = std::get_if<SwingTracker<float>>(&estimator_)) {
      return tracker->update(sample);
    }
    return std::nullopt;
  }

  wire::Result carry_out(const wire::BeginRig& command) { return upload_.begin(command); }
  wire::Result carry_out(const wire::RigPart& command) { return upload_.take(command); }
  wire::Result carry_out(const wire::EndRig& /*command*/) {
    if (const wire::Result result = upload_.finish(); result != wire::Result::kDone) {
      return result;
    }
    if (!is_suitable_rig(upload_.image())) {
      return wire::Result::kInvalidRig;
    }
    if (!write_rig(store_, upload_.image())) {
      return wire::Result::kStoreFailed;
    }
    use_stored_rig(rate_millihz_);
    return wire::Result::kDone;
  }
  wire::Result carry_out(const wire::EraseRig& /*command*/) {
    const bool erased = store_.replace({});
    use_stored_rig(rate_millihz_);
    return erased ? wire::Result::kDone : wire::Result::kStoreFailed;
  }

 private:
  /// Whether a rig is one of this board's two sensors.
  [[nodiscard]] static bool suits(const std::optional<wire::BoardRig>& rig) {
    return rig && rig->rig.layout.count == kChannels;
  }

  /// Not inline, so that its rig is off the stack when the stored one is read.
  [[gnu::noinline]] static bool is_suitable_rig(std::span<const std::uint8_t> image) {
    return suits(wire::decode_rig(image));
  }

  BoardStore& store_;
  std::uint32_t rate_millihz_ = 0;
  wire::StoreState state_ = wire::StoreState::kEmpty;
  /// In one place, since each has a rig of its own.
  std::variant<std::monostate, Pipeline<float>, SwingTracker<float>> estimator_;
  RigUpload upload_;
};

}  // namespace penduline
