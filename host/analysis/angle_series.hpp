// SPDX-License-Identifier: Apache-2.0
// Angles over time, as an analysis takes them: from a table or from a recording.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <tl/expected.hpp>
#include <vector>

#include "common/flags.hpp"
#include "common/rig.hpp"
#include "hal/error.hpp"
#include "host/analysis/number_table.hpp"
#include "host/flag_counts.hpp"

namespace penduline {

/// Angles near a restart or after a dropout are as good as others: each stands for itself.
inline constexpr Flags kHarmlessToAngles =
    flag::kOrdinary | flag::kOverrun | flag::kLate | flag::kDropout;

/// Angles that can be trusted, at rising times.
struct AngleSeries {
  std::vector<double> t_s{};
  std::vector<double> theta1_rad{};
  std::vector<double> theta2_rad{};  ///< all 0 where the swing is `planar`
  bool planar = false;               ///< the file has one angle only
  std::size_t left_out = 0;          ///< rows without angles, or with a flag against them
  std::size_t without_angles = 0;    ///< of these
  FlagCounts flags_against{};        ///< those that the rows left out have

  /// In words: "1180 of 1200 rows are left out (20 without angles; 1160 disturbed)"; empty where
  /// none is.
  [[nodiscard]] std::string left_out_text() const;
  [[nodiscard]] std::size_t size() const { return t_s.size(); }
  /// The rows from the moment `from_s` to `to_s`, both included.
  [[nodiscard]] AngleSeries between(double from_s, double to_s) const;
  /// The first of each `stride` rows, 1 or more.
  [[nodiscard]] AngleSeries thinned(std::size_t stride) const;
  /// The usual time from row to row; 0 below two rows.
  [[nodiscard]] double period_s() const;
};

/// Whether the first line that is no comment names angles, not readings of sensors. Fails where the
/// file cannot be read.
[[nodiscard]] tl::expected<bool, Error> is_angle_table(const std::string& path);

/// Why a file without angles is refused where no rig makes angles of its readings.
[[nodiscard]] Error no_angles(const std::string& path);

/// Where a table has its angles.
struct AngleColumns {
  std::size_t t_s = 0;
  std::size_t theta1 = 0;  ///< `theta1_rad`, or `theta_rad` alone
  std::optional<std::size_t> theta2{};
  std::optional<std::size_t> flags{};
};

/// Fails, naming file and line, where time or angles are missing.
[[nodiscard]] tl::expected<AngleColumns, Error> find_angle_columns(const NumberTable& table);

/// Reads columns separated by commas: `t_s` with `theta1_rad` and `theta2_rad`, or with `theta_rad`
/// alone. Others are ignored but `flags`. Fails, naming file and line, where one is missing, a cell
/// is no number or the time does not rise.
[[nodiscard]] tl::expected<AngleSeries, Error> read_angle_table(const std::string& path);

/// The angles of each sample of a recording by itself: no filter, so that noise is independent from
/// row to row and nothing is bent. Fails as reading does, where the board's clock starts anew, and
/// once `stopped` says so; that may be empty.
[[nodiscard]] tl::expected<AngleSeries, Error> angles_of_recording(
    const std::string& path, const Rig<double>& rig, const std::function<bool()>& stopped = {});

}  // namespace penduline
