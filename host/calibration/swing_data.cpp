// SPDX-License-Identifier: Apache-2.0
// First guesses: angles by the inverse, the start by a harmonic through them.
#include "host/calibration/swing_data.hpp"

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/gauss_newton.hpp"

#include "host/units.hpp"

namespace penduline {
namespace {

constexpr double kSamplesAPeriod = 32;
constexpr double kFewestPeriods = 5;

/// The angles that one sample's signals mean, if all sensors say something sound.
struct TiltReading {
  std::optional<Angles<double>> angles{};
  std::array<bool, kMaxSensors> doubtful{};
};

TiltReading read(const Rig<double>& rig, const GaussNewton<double>& inverse,
                 const std::array<double, kMaxSensors>& volts,
                 const std::array<double, kMaxSensors>& gain) {
  TiltReading reading;
  std::array<double, kMaxSensors> gaps{};
  bool all = true;
  for (std::size_t i = 0; i < rig.layout.count; ++i) {
    const GapReading<double> gap = rig.responses[i].read(volts[i] / gain[i]);
    reading.doubtful[i] = !gap.gap_m || (gap.flags & flag::kFolded) != 0;
    all = all && gap.gap_m.has_value() && std::isfinite(volts[i]);
    gaps[i] = gap.gap_m.value_or(0);
  }
  if (all) {
    const auto solved = inverse.solve({gaps.data(), rig.layout.count});
    if (solved) {
      reading.angles = angles_of(solved->slopes);
    }
  }
  return reading;
}

/// Samples beside a folded one may be folded too and look sound.
void widen(std::vector<std::array<bool, kMaxSensors>>& doubtful, std::size_t sensor) {
  constexpr std::size_t kBeside = 2;
  const std::vector<std::array<bool, kMaxSensors>> before = doubtful;
  for (std::size_t i = 0; i < before.size(); ++i) {
    for (std::size_t k = i > kBeside ? i - kBeside : 0;
         before[i][sensor] && k <= std::min(i + kBeside, before.size() - 1); ++k) {
      doubtful[k][sensor] = true;
    }
  }
}

/// A cos(wt) + B sin(wt) + C through the first one and a half periods of an angle.
Eigen::Vector2d harmonic(const std::vector<double>& t_s, const std::vector<double>& angle,
                         double omega) {
  Eigen::MatrixXd terms(std::ssize(t_s), 3);
  for (std::size_t i = 0; i < t_s.size(); ++i) {
    const double phase = omega * t_s[i];
    terms.row(static_cast<Eigen::Index>(i)) << std::cos(phase), std::sin(phase), 1;
  }
  const Eigen::Vector3d found = terms.colPivHouseholderQr().solve(
      Eigen::Map<const Eigen::VectorXd>(angle.data(), std::ssize(angle)));
  return found.head<2>();
}

/// When the pendulum was let go: the last sample that is where the first ones are.
double released_s(const std::vector<double>& t_s, const std::vector<Angles<double>>& angles) {
  constexpr double kMovedRad = 0.3 * kDegree;
  std::size_t i = 0;
  while (i + 1 < angles.size() &&
         std::hypot(angles[i + 1].theta1_rad - angles[0].theta1_rad,
                    angles[i + 1].theta2_rad - angles[0].theta2_rad) < kMovedRad) {
    ++i;
  }
  return t_s[i];
}

tl::expected<void, Error> begin(SwingData& data, const Rig<double>& rig,
                                const std::vector<double>& t_s,
                                const std::vector<Angles<double>>& angles) {
  constexpr double kLeastRad = 1 * kDegree;
  constexpr std::size_t kFewest = 8;
  const double omega = 2 * std::numbers::pi * small_swing_hz(rig.pendulum);
  std::vector<double> times;
  std::vector<double> angle1;
  std::vector<double> angle2;
  const double from_s = data.release ? data.released_s : data.t_s.front();
  for (std::size_t i = 0; i < t_s.size(); ++i) {
    if (t_s[i] >= from_s && t_s[i] - from_s < 3 * std::numbers::pi / omega) {
      times.push_back(t_s[i] - from_s);
      angle1.push_back(angles[i].theta1_rad);
      angle2.push_back(angles[i].theta2_rad);
    }
  }
  if (times.size() < kFewest) {
    return failure(fmt::format(
        "{}: found {} samples of the first swing that the rig's responses can read, expected {} or "
        "more: is it this rig's recording?",
        data.name, times.size(), kFewest));
  }
  const Eigen::Vector2d first = harmonic(times, angle1, omega);
  const Eigen::Vector2d second = harmonic(times, angle2, omega);
  if (std::hypot(first.norm(), second.norm()) < kLeastRad) {
    return failure(fmt::format("{}: found a swing of {:.2f} deg, expected 1 deg or more", data.name,
                               std::hypot(first.norm(), second.norm()) / kDegree));
  }
  data.start = {.theta1_rad = first[0],
                .theta2_rad = second[0],
                .omega1_rad_s = first[1] * omega,
                .omega2_rad_s = second[1] * omega};
  return {};
}

tl::expected<SwingData, Error> data_of(const SignalLog& log, const Rig<double>& rig,
                                       const std::array<double, kMaxSensors>& gain,
                                       const std::optional<Release>& release) {
  const double swing_hz = small_swing_hz(rig.pendulum);
  const double periods = (log.t_s.back() - log.t_s.front()) * swing_hz;
  if (periods < kFewestPeriods) {
    return failure(fmt::format("{}: found {:.1f} periods of the swing, expected {:.0f} or more",
                               log.path, periods, kFewestPeriods));
  }
  if (log.acquisition.rate_hz < 4 * swing_hz) {
    return failure(
        fmt::format("{}: found {} samples a second, expected {:.1f} or more for a swing "
                    "of {:.2f} Hz",
                    log.path, log.acquisition.rate_hz, 4 * swing_hz, swing_hz));
  }
  const auto stride = static_cast<std::size_t>(
      std::max(1.0, std::floor(log.acquisition.rate_hz / (kSamplesAPeriod * swing_hz))));
  const GaussNewton<double> inverse(rig.layout);
  SwingData data{
      .name = log.path, .t_s = {}, .volts = {}, .doubtful = {}, .start = {}, .release = release};
  std::vector<double> t_s;
  std::vector<Angles<double>> angles;
  for (std::size_t i = 0; i < log.t_s.size(); i += stride) {
    const TiltReading reading = read(rig, inverse, log.volts[i], gain);
    data.t_s.push_back(log.t_s[i]);
    data.volts.push_back(log.volts[i]);
    data.doubtful.push_back(reading.doubtful);
    if (reading.angles) {
      t_s.push_back(log.t_s[i]);
      angles.push_back(*reading.angles);
    }
  }
  for (std::size_t i = 0; i < rig.layout.count; ++i) {
    widen(data.doubtful, i);
  }
  if (release && !t_s.empty()) {
    data.released_s = released_s(t_s, angles);
  }
  return begin(data, rig, t_s, angles).map([&] { return data; });
}

}  // namespace

std::array<double, kMaxSensors> rest_signals(const std::vector<SignalLog>& logs,
                                             std::size_t sensor_count) {
  std::array<double, kMaxSensors> medians{};
  for (std::size_t i = 0; i < sensor_count; ++i) {
    std::vector<double> volts;
    for (const SignalLog& log : logs) {
      const std::vector<double> signals = log.signals(i, log.t_s.front(), log.t_s.back());
      volts.insert(volts.end(), signals.begin(), signals.end());
    }
    if (!volts.empty()) {
      const auto middle = volts.begin() + std::ssize(volts) / 2;
      std::ranges::nth_element(volts, middle);
      medians[i] = *middle;
    }
  }
  return medians;
}

tl::expected<std::vector<SwingData>, Error> swing_data(const std::vector<SignalLog>& logs,
                                                       const Rig<double>& rig,
                                                       const std::array<double, kMaxSensors>& gain,
                                                       const std::optional<Release>& release) {
  std::vector<SwingData> swings;
  for (const SignalLog& log : logs) {
    auto data = data_of(log, rig, gain, release);
    if (!data) {
      return tl::unexpected(data.error());
    }
    swings.push_back(std::move(*data));
  }
  return swings;
}

}  // namespace penduline
