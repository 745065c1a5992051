// SPDX-License-Identifier: Apache-2.0
// A quarter left out at most, 0.2 mm of misfit at most.
#include "host/calibration/swing_checks.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "host/units.hpp"

namespace penduline {
namespace {

constexpr double kMostLeftOut = 0.25;

}  // namespace

tl::expected<void, Error> require_beyond_fold(const RigFile& rig,
                                              const std::vector<SwingData>& swings) {
  for (const SwingData& swing : swings) {
    for (std::size_t i = 0; i < rig.rig.layout.count; ++i) {
      const auto doubtful = std::ranges::count_if(
          swing.doubtful, [&](const std::array<bool, kMaxSensors>& of) { return of[i]; });
      const double share =
          static_cast<double>(doubtful) / static_cast<double>(swing.doubtful.size());
      if (share > kMostLeftOut) {
        return failure(fmt::format(
            "{}: sensor {}: {:.0f} % of the samples are at the fold of its response or beside it, "
            "nearer than {:.2f} mm, or unreadable, expected {:.0f} % or less: swing less far, or "
            "mount it higher",
            swing.name, rig.sensor_names[i], share * 100,
            nearest_readable_m(rig.rig.responses[i]) / kMillimetre, kMostLeftOut * 100));
      }
    }
  }
  return {};
}

tl::expected<void, Error> require_good_swing(const SignalFit& fit,
                                             const std::vector<SignalLog>& logs,
                                             const Pendulum<double>& pendulum) {
  constexpr double kMostResidualM = 0.2e-3;
  const std::string& path = logs.front().path;
  if (fit.residual_m > kMostResidualM) {
    return failure(fmt::format(
        "{}: the best fit misses the gaps by {:.2f} mm RMS, expected {:.1f} mm or less: no free "
        "swing of one pendulum of about {} m does that",
        path, fit.residual_m / kMillimetre, kMostResidualM / kMillimetre, pendulum.length_m));
  }
  if (fit.release_s < -0.1 / small_swing_hz(pendulum)) {
    return failure(
        fmt::format("{}: the pendulum was let go {:.2f} s before the recording begins, "
                    "expected the release to be in it",
                    path, -fit.release_s));
  }
  return {};
}

tl::expected<void, Error> account_for_left_out(const RigFile& rig, std::size_t sensor,
                                               const SignalFit& fit, const std::string& where,
                                               const std::string& path, Calibration& result) {
  const std::string& name = rig.sensor_names[sensor];
  const std::size_t left_out = fit.left_out[sensor];
  const std::size_t all = left_out + fit.used[sensor].size();
  const double share =
      static_cast<double>(left_out) / static_cast<double>(std::max<std::size_t>(all, 1));
  if (share > kMostLeftOut) {
    return failure(fmt::format(
        "{}: sensor {}: {:.0f} % of the samples are {}, expected {:.0f} % or less: swing less far, "
        "or mount it higher",
        path, name, share * 100, where, kMostLeftOut * 100));
  }
  if (left_out > 0) {
    result.warnings.push_back(fmt::format("sensor {}: {} of {} samples are left out: they are {}",
                                          name, left_out, all, where));
  }
  return {};
}

void put_numbers(const SignalFit& fit, Calibration& result) {
  result.record.parameters = fit.names;
  result.record.values = fit.fit.values;
  result.record.covariance = fit.fit.covariance;
  std::vector<std::string> held;
  for (const std::size_t i : fit.fit.at_bound) {
    held.push_back(fit.names[i]);
  }
  if (!held.empty()) {
    result.notes.push_back(
        fmt::format("held at 0, for less than none is no friction: {}", fmt::join(held, ", ")));
  }
}

}  // namespace penduline
