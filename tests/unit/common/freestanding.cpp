// SPDX-License-Identifier: Apache-2.0
// All of common for both scalars, compiled as firmware is: no exceptions, no RTTI, no hidden
// double.
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "common/bisection.hpp"
#include "common/closed_form.hpp"
#include "common/continuity.hpp"
#include "common/denavit_hartenberg.hpp"
#include "common/disc_plane.hpp"
#include "common/dynamics.hpp"
#include "common/estimate.hpp"
#include "common/filter_trust.hpp"
#include "common/fir.hpp"
#include "common/flags.hpp"
#include "common/gap_gradient.hpp"
#include "common/gap_measurement.hpp"
#include "common/gauss_newton.hpp"
#include "common/innovation_watch.hpp"
#include "common/monotone_cubic.hpp"
#include "common/motion_noise.hpp"
#include "common/pipeline.hpp"
#include "common/response.hpp"
#include "common/rig.hpp"
#include "common/sample.hpp"
#include "common/swing_estimate.hpp"
#include "common/swing_filter.hpp"
#include "common/swing_step.hpp"
#include "common/swing_tracker.hpp"
#include "common/window_flags.hpp"
#include "common/window_moment.hpp"
#include "common/wire/bytes.hpp"
#include "common/wire/choices.hpp"
#include "common/wire/cobs.hpp"
#include "common/wire/commands.hpp"
#include "common/wire/crc32.hpp"
#include "common/wire/decoder.hpp"
#include "common/wire/device_messages.hpp"
#include "common/wire/field.hpp"
#include "common/wire/frame.hpp"
#include "common/wire/messages.hpp"
#include "common/wire/rig_image.hpp"
#include "common/wire/sample_message.hpp"
#include "common/wire/text.hpp"

namespace penduline {

template class ClosedForm<float>;
template class ClosedForm<double>;
template bool determines_tilt(const SensorLayout<float>&);
template bool determines_tilt(const SensorLayout<double>&);

template Transform<float> sensor_x_chain(const Angles<float>&, float, float, float);
template Transform<double> sensor_x_chain(const Angles<double>&, double, double, double);
template Transform<float> sensor_y_chain(const Angles<float>&, float, float, float);
template Transform<double> sensor_y_chain(const Angles<double>&, double, double, double);

template class DiscPlane<float>;
template class DiscPlane<double>;
template Slopes<float> slopes_of(const Angles<float>&);
template Slopes<double> slopes_of(const Angles<double>&);
template Angles<float> angles_of(const Slopes<float>&);
template Angles<double> angles_of(const Slopes<double>&);
template bool beam_meets_disc(const SensorLayout<float>&, std::size_t, float, float);
template bool beam_meets_disc(const SensorLayout<double>&, std::size_t, double, double);

template SwingState<float> swing_derivative(const SwingState<float>&, const Pendulum<float>&);
template SwingState<double> swing_derivative(const SwingState<double>&, const Pendulum<double>&);
template float energy_j(const SwingState<float>&, const Pendulum<float>&);
template double energy_j(const SwingState<double>&, const Pendulum<double>&);
template float small_swing_hz(const Pendulum<float>&);
template double small_swing_hz(const Pendulum<double>&);

template struct Estimate<float>;
template struct Estimate<double>;

template FirTaps<float> design_lowpass(const FilterDesign<float>&);
template FirTaps<double> design_lowpass(const FilterDesign<double>&);
template float gain_at(const FirTaps<float>&, float);
template double gain_at(const FirTaps<double>&, double);
template class FirFilter<float>;
template class FirFilter<double>;
template FilterDesign<float> default_filter(float, float);
template FilterDesign<double> default_filter(double, double);

template class GaussNewton<float>;
template class GaussNewton<double>;

template class MonotoneCubic<float>;
template class MonotoneCubic<double>;

template class Pipeline<float>;
template class Pipeline<double>;

template struct LinearResponse<float>;
template struct LinearResponse<double>;
template struct TableResponse<float>;
template struct TableResponse<double>;
template struct InverseSquareResponse<float>;
template struct InverseSquareResponse<double>;
template struct PolynomialResponse<float>;
template struct PolynomialResponse<double>;
template struct Response<float>;
template struct Response<double>;

template struct Rig<float>;
template struct Rig<double>;

template class SwingFilter<float>;
template class SwingFilter<double>;
template class SwingTracker<float>;
template class SwingTracker<double>;
template Estimate<float> SwingTracker<float>::update(const Sample&, NoWitness&&);
template Estimate<double> SwingTracker<double>::update(const Sample&, NoWitness&&);

template float signal_v(Reading, const Acquisition<float>&);
template double signal_v(Reading, const Acquisition<double>&);

namespace wire {

template std::size_t encode_frame(const Hello&, std::span<std::uint8_t>);
template std::optional<Hello> read_message(std::span<const std::uint8_t>);
template std::size_t encode_frame(const SampleMessage&, std::span<std::uint8_t>);
template std::optional<SampleMessage> read_message(std::span<const std::uint8_t>);
template std::size_t encode_frame(const Status&, std::span<std::uint8_t>);
template std::optional<Status> read_message(std::span<const std::uint8_t>);
template std::size_t encode_frame(const AnglesMessage&, std::span<std::uint8_t>);
template std::optional<AnglesMessage> read_message(std::span<const std::uint8_t>);
template std::size_t encode_frame(const Pong&, std::span<std::uint8_t>);
template std::optional<Pong> read_message(std::span<const std::uint8_t>);
template std::size_t encode_frame(const Reply&, std::span<std::uint8_t>);
template std::optional<Reply> read_message(std::span<const std::uint8_t>);
template std::size_t encode_frame(const Ping&, std::span<std::uint8_t>);
template std::optional<Ping> read_message(std::span<const std::uint8_t>);
template std::size_t encode_frame(const AskHello&, std::span<std::uint8_t>);
template std::optional<AskHello> read_message(std::span<const std::uint8_t>);
template std::size_t encode_frame(const AskStatus&, std::span<std::uint8_t>);
template std::optional<AskStatus> read_message(std::span<const std::uint8_t>);
template std::size_t encode_frame(const SetRate&, std::span<std::uint8_t>);
template std::optional<SetRate> read_message(std::span<const std::uint8_t>);
template std::size_t encode_frame(const SetEmitter&, std::span<std::uint8_t>);
template std::optional<SetEmitter> read_message(std::span<const std::uint8_t>);
template std::size_t encode_frame(const Identify&, std::span<std::uint8_t>);
template std::optional<Identify> read_message(std::span<const std::uint8_t>);
template std::size_t encode_frame(const Reboot&, std::span<std::uint8_t>);
template std::optional<Reboot> read_message(std::span<const std::uint8_t>);
template std::size_t encode_frame(const BeginRig&, std::span<std::uint8_t>);
template std::optional<BeginRig> read_message(std::span<const std::uint8_t>);
template std::size_t encode_frame(const RigPart&, std::span<std::uint8_t>);
template std::optional<RigPart> read_message(std::span<const std::uint8_t>);
template std::size_t encode_frame(const EndRig&, std::span<std::uint8_t>);
template std::optional<EndRig> read_message(std::span<const std::uint8_t>);
template std::size_t encode_frame(const EraseRig&, std::span<std::uint8_t>);
template std::optional<EraseRig> read_message(std::span<const std::uint8_t>);

}  // namespace wire

}  // namespace penduline
