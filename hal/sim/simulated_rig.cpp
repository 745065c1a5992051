// SPDX-License-Identifier: Apache-2.0
// The physics between the pendulum's angles and the ADC's pins.
#include "hal/sim/simulated_rig.hpp"

#include <algorithm>
#include <boost/random/normal_distribution.hpp>
#include <cmath>

namespace penduline {
namespace {

/// Boost's, because the standard's may differ from one library to the next: one seed, one result.
double draw(std::mt19937_64& random, double sigma) {
  return sigma > 0 ? boost::random::normal_distribution<double>(0, sigma)(random) : 0;
}

/// Signal nearer than the peak, as a share of the peak's: a parabola that stays within 0.03 of the
/// data sheet's points at 0.5, 1 and 2 mm for its peak at 2.36 mm.
double folded_share(double gap_over_peak) {
  constexpr double kLossAtContact = 0.58;
  const double missing = 1 - gap_over_peak;
  return 1 - kLossAtContact * missing * missing;
}

}  // namespace

double sensor_signal_v(const Response<double>& response, double gap_m) {
  gap_m = std::max(0.0, gap_m);
  const double signal = gap_m >= response.peak_m ? response.volts(gap_m)
                                                 : response.volts(response.peak_m) *
                                                       folded_share(gap_m / response.peak_m);
  return std::max(0.0, signal);
}

SimulatedRig::SimulatedRig(const Rig<double>& rig, const SimulationSettings& settings)
    : rig_(rig),
      settings_(settings),
      motion_(make_motion(settings.integrator, settings.start, rig.pendulum, 1 / settings.rate_hz)),
      random_(settings.seed),
      start_energy_j_(energy_j(motion_->state(), rig.pendulum)) {}

void SimulatedRig::advance_to(double t_s) {
  motion_->advance_to(t_s);
  const double energy = energy_j(motion_->state(), rig_.pendulum);
  if (std::isinf(blown_up_at_s_) && !(energy <= 2 * start_energy_j_)) {
    blown_up_at_s_ = t_s;
  }
  for (std::size_t i = 0; i < rig_.layout.count; ++i) {
    signals_v_[i] = signal_v(i);
  }
}

double SimulatedRig::signal_v(std::size_t sensor) {
  const SwingState<double> state = motion_->state();
  const double upright = std::cos(state.theta1_rad) * std::cos(state.theta2_rad);
  if (!(upright > 0)) {
    return 0;  // the disc shows its edge or its back
  }
  const DiscPlane<double> plane(slopes_of<double>({state.theta1_rad, state.theta2_rad}));
  const double gap_m = plane.gap_m(rig_.layout, sensor) + draw(random_, settings_.gap_noise_m);
  if (!beam_meets_disc(rig_.layout, sensor, gap_m, rig_.disc_diameter_m)) {
    return 0;
  }
  return sensor_signal_v(rig_.responses[sensor], gap_m);
}

double SimulatedRig::pin_v(std::size_t sensor, bool emitter_lit) {
  return settings_.ambient_v + (emitter_lit ? signals_v_[sensor] : 0) +
         draw(random_, settings_.noise_v);
}

}  // namespace penduline
