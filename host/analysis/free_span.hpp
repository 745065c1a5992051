// SPDX-License-Identifier: Apache-2.0
// Where in a series of angles the pendulum swings freely: not held, not pushed, not at rest.
#pragma once

#include <tl/expected.hpp>

#include "hal/error.hpp"
#include "host/analysis/angle_series.hpp"

namespace penduline {

/// The period of the strongest swinging in a series, to a few per cent: the peak of the rates'
/// spectrum, in which a hand that holds or moves the pendulum slowly counts little. 0 where there
/// is none.
[[nodiscard]] double strongest_period_s(const AngleSeries& series);

/// A free swing's place in a series.
struct FreeSpan {
  double from_s = 0;
  double to_s = 0;
  double period_s = 0;  ///< of its swings, roughly
};

/// The longest part in which each swing is an ellipse about one centre, no larger than the one
/// before and larger than a twentieth of the largest. Fails, in words, where no part has
/// `kFewestSwings` of them.
inline constexpr int kFewestSwings = 3;
[[nodiscard]] tl::expected<FreeSpan, Error> find_free_span(const AngleSeries& series);

}  // namespace penduline
