// SPDX-License-Identifier: Apache-2.0
// A simulated rig: what stands at the ADC's pins while the pendulum swings, in virtual time.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <random>

#include "common/rig.hpp"
#include "hal/sim/motion.hpp"

namespace penduline {

/// What the simulated rig does and what disturbs it.
struct SimulationSettings {
  SwingStart start;
  Integrator integrator = Integrator::kDopri5;
  std::optional<double> duration_s = 10;  ///< none: endless
  double rate_hz = 20;
  double ambient_v = 0.1;        ///< what the room's light adds, lit or dark
  double noise_v = 0.002;        ///< RMS, of each conversion
  double gap_noise_m = 0;        ///< RMS, of each sample's gaps
  bool emitter_switched = true;  ///< false: always lit, so that ambient light stays in the signal
  int adc_bits = 12;             ///< 1..16
  double reference_v = 3.3;
  int conversions = 32;  ///< averaged, each, for the lit and the dark reading of a sample
  std::uint64_t seed = 1;
};

/// A sensor's signal for a gap: the response's, which from its peak on towards the disc folds back
/// as a TCRT5000's does (Vishay data sheet 83760, figure 9). Never negative.
[[nodiscard]] double sensor_signal_v(const Response<double>& response, double gap_m);

/// Pendulum, disc, sensors and ambient light.
class SimulatedRig {
 public:
  SimulatedRig(const Rig<double>& rig, const SimulationSettings& settings);

  /// Lets the time pass; each call draws new gap noise.
  void advance_to(double t_s);

  /// Voltage at a sensor's pin, noise of one conversion included.
  double pin_v(std::size_t sensor, bool emitter_lit);

  /// The true state of the pendulum.
  [[nodiscard]] SwingState<double> truth() const { return motion_->state(); }

  /// When the integrator ran away: its energy doubled though nothing drives the pendulum. Infinity
  /// until then.
  [[nodiscard]] double blown_up_at_s() const { return blown_up_at_s_; }

 private:
  [[nodiscard]] double signal_v(std::size_t sensor);

  Rig<double> rig_;
  SimulationSettings settings_;
  std::unique_ptr<Motion> motion_;
  std::array<double, kMaxSensors> signals_v_{};
  std::mt19937_64 random_;
  double start_energy_j_;
  double blown_up_at_s_ = std::numeric_limits<double>::infinity();
};

}  // namespace penduline
