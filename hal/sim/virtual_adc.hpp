// SPDX-License-Identifier: Apache-2.0
// Emitters and ADC of the simulated board: bursts of conversions of a simulated rig's pins.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "hal/concepts.hpp"
#include "hal/sim/simulated_rig.hpp"
#include "hal/sim/virtual_clock.hpp"

namespace penduline::sim {

/// Both emitters, and how long their light takes to be seen.
class Emitters {
 public:
  /// Until then after a switch the pins stand as they did before it: a TCRT5000 with 10 kOhm.
  static constexpr std::uint64_t kRiseUs = 50;

  explicit Emitters(const VirtualClock& clock) : clock_(clock) {}

  void set(bool lit) {
    switched_at_us_ = lit == lit_ ? switched_at_us_ : clock_.now_us();
    lit_ = lit;
  }

  /// Whether the sensors see their emitters lit.
  [[nodiscard]] bool seen_lit() const {
    return clock_.now_us() - switched_at_us_ < kRiseUs ? !lit_ : lit_;
  }

 private:
  const VirtualClock& clock_;
  std::uint64_t switched_at_us_ = 0;
  bool lit_ = false;
};

static_assert(Emitter<Emitters>);

/// 12 bits, 2 us a conversion, as the RP2040's. The rig's first two sensors are the channels.
class Adc {
 public:
  static constexpr std::uint16_t kTopCode = 4095;
  static constexpr std::uint32_t kConversionNs = 2000;

  Adc(VirtualClock& clock, const Emitters& emitters, SimulatedRig& rig, double reference_v)
      : clock_(clock), emitters_(emitters), rig_(rig), reference_v_(reference_v) {}

  /// The burst's end comes as Alarm::kBurst, unless the ADC stands still.
  bool convert(std::uint8_t first_channel, std::uint16_t* codes) {
    constexpr std::uint64_t kBurstUs = kConversionsPerBurst * kConversionNs / 1000;
    const bool lit = emitters_.seen_lit();
    for (std::size_t i = 0; i < kConversionsPerBurst; ++i) {
      codes[i] = code_of(rig_.pin_v((first_channel + i) % kChannels, lit));
    }
    if (!stands_still_) {
      clock_.set_alarm(Alarm::kBurst, clock_.now_us() + kBurstUs);
    }
    return false;
  }

  /// A fault for tests: no burst ends any more.
  void stand_still() { stands_still_ = true; }

 private:
  [[nodiscard]] std::uint16_t code_of(double volts) const {
    const double code = std::round(volts / reference_v_ * kTopCode);
    // A rig that has run away has no voltage at all.
    return std::isnan(code) ? std::uint16_t{0}
                            : static_cast<std::uint16_t>(std::clamp(code, 0.0, double{kTopCode}));
  }

  VirtualClock& clock_;
  const Emitters& emitters_;
  SimulatedRig& rig_;
  double reference_v_;
  bool stands_still_ = false;
};

static_assert(BurstConverter<Adc>);

}  // namespace penduline::sim
