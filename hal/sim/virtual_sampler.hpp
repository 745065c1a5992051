// SPDX-License-Identifier: Apache-2.0
// Windows at a steady rate in virtual time, taken of a simulated rig.
#pragma once

#include <cstdint>

#include "hal/concepts.hpp"
#include "hal/sim/simulated_rig.hpp"
#include "hal/sim/virtual_adc.hpp"
#include "hal/sim/virtual_clock.hpp"
#include "hal/window_schedule.hpp"
#include "hal/window_sequencer.hpp"

namespace penduline::sim {

/// The pendulum stands still during a window, at its place in the window's middle.
class Sampler {
 public:
  static constexpr std::uint32_t kWindowUs = window_us(Adc::kConversionNs);
  static constexpr std::uint16_t kTopCode = Adc::kTopCode;

  /// The rig is `since_us` older than the board's clock, which begins anew at each reset.
  Sampler(VirtualClock& clock, Adc& adc, Emitters& emitters, SimulatedRig& rig,
          std::uint64_t since_us)
      : clock_(clock), rig_(rig), since_us_(since_us), sequencer_(emitters, adc, clock) {}

  void start(std::uint32_t period_us, EmitterMode mode) {
    if (schedule_.start(period_us, mode, clock_.now_us())) {
      clock_.set_alarm(Alarm::kWindow, schedule_.due_us());
    }
  }

  bool take(Window& window) { return sequencer_.take(window); }

  void on_window_alarm() {
    if (sequencer_.idle()) {
      const std::uint64_t middle_us = since_us_ + clock_.now_us() + kWindowUs / 2;
      rig_.advance_to(static_cast<double>(middle_us) / 1e6);
    }
    schedule_.on_alarm(sequencer_, clock_);
    clock_.set_alarm(Alarm::kWindow, schedule_.due_us());
  }
  void on_settled() { sequencer_.on_wake_up(); }
  void on_burst_done() { sequencer_.on_burst_done(); }

 private:
  VirtualClock& clock_;
  SimulatedRig& rig_;
  std::uint64_t since_us_;
  WindowSequencer<Emitters, Adc, VirtualClock> sequencer_;
  WindowSchedule schedule_;
};

static_assert(PairedSampler<Sampler>);

}  // namespace penduline::sim
