// SPDX-License-Identifier: Apache-2.0
// An estimate: the angles at one moment and what goes with them.
#pragma once

#include <cstdint>
#include <optional>

#include "common/disc_plane.hpp"
#include "common/flags.hpp"

namespace penduline {

/// What an estimator knows of one moment; each part is absent rather than wrong.
template <class Scalar>
struct Estimate {
  /// Angles and the mass's position that follows from them.
  struct Attitude {
    Angles<Scalar> angles;
    Vector3<Scalar> mass_m = Vector3<Scalar>::Zero();
  };
  /// One number for each of the two angles.
  struct Pair {
    Scalar first;
    Scalar second;
  };

  std::int64_t t_us = 0;  ///< the moment that the angles refer to, in device time
  std::uint64_t seq = 0;  ///< the newest sample that went in
  std::optional<Attitude> attitude{};
  std::optional<Pair> omega_rad_s{};     ///< rates, from estimators that know them
  std::optional<Pair> sigma_rad{};       ///< standard deviations, from estimators that know them
  std::optional<Scalar> residual_m{};    ///< RMS misfit of the gaps
  std::optional<std::int64_t> utc_us{};  ///< `t_us` since 1970, where a host knows it
  Flags flags = 0;
};

}  // namespace penduline
