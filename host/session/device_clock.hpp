// SPDX-License-Identifier: Apache-2.0
// How the board's clock stands against the host's, from Pings and Pongs over a link that delays
// them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "host/session/clock_exchange.hpp"
#include "host/session/round_trips.hpp"

namespace penduline {

/// Follows offset and drift by a Kalman filter (docs/method.md, "The board's clock"). It reads no
/// clock itself: the same exchanges give the same answers. One exchange a second is enough.
class DeviceClock {
 public:
  enum class Verdict {
    kBegun,     ///< the first one, or one that says that the board or the host's clock started anew
    kUsed,      ///< the better, the shorter its round trip
    kRejected,  ///< contradicts all that came before; a third one in a row would be right
  };

  /// Takes the next exchange. A board's time that goes back is a restart.
  Verdict take(const ClockExchange& exchange);
  /// Forgets the clock, for the board has started anew; what was counted stays.
  void reset();

  /// A moment of the host's, and how far off it may be: what jitter leaves, twice its standard
  /// deviation, and what nobody can know, how the delays divide between the ways there and back.
  struct HostMoment {
    std::int64_t monotonic_us;  ///< CLOCK_MONOTONIC
    std::int64_t utc_us;        ///< since 1970, by the host's CLOCK_REALTIME as it last stood
    double uncertainty_us;
  };
  /// The host's time at the board's time `t_us`, before or after the latest exchange; none before
  /// the first.
  [[nodiscard]] std::optional<HostMoment> host_moment(std::int64_t t_us) const;

  /// A moment of the board's, and how far off it may be, as for a HostMoment.
  struct BoardMoment {
    std::int64_t t_us;
    double uncertainty_us;
  };
  /// The board's time at the host's time `monotonic_us` (CLOCK_MONOTONIC); none before the first
  /// exchange, and where the board had not started yet.
  [[nodiscard]] std::optional<BoardMoment> board_moment(std::int64_t monotonic_us) const;

  struct Drift {
    double ppm;              ///< above 0 where the board's clock is fast
    double uncertainty_ppm;  ///< twice the standard deviation
  };
  /// How fast the board's clock is now; none before the second exchange.
  [[nodiscard]] std::optional<Drift> drift() const;

  /// In words, for the summary: "the board's clock is 12.3 +- 0.8 ppm fast and known within 0.21 ms
  /// (118 Pongs, 2 rejected)".
  [[nodiscard]] std::string text() const;

 private:
  /// Host's time less board's, at some moment, and what is known of it.
  struct State {
    double offset_us = 0;
    double drift = 0;  ///< of the offset, in us per us
    double offset_variance = 0;
    double covariance = 0;
    double drift_variance = 0;
  };

  void begin(const ClockExchange& exchange);
  void note_shortest(std::int64_t shortest_us);
  [[nodiscard]] State at(std::int64_t t_us) const;
  [[nodiscard]] double uncertainty_us(const State& state) const;
  /// What a round trip may hide beyond the shortest, or behind it while few are known.
  [[nodiscard]] double doubt_us(std::int64_t round_trip_us) const;
  void correct(const State& predicted, double measured_us, double doubt_us);

  RoundTrips round_trips_;
  State state_;
  std::int64_t reference_us_ = 0;  ///< board's time that `state_` is of
  std::int64_t shortest_us_ = 0;
  double one_sided_us_ = 0;  ///< error that the delays would leave if all were on one way
  std::int64_t utc_less_monotonic_us_ = 0;
  int used_ = 0;  ///< since it began
  int rejected_in_a_row_ = 0;
  std::uint64_t taken_ = 0;
  std::uint64_t rejected_ = 0;
};

}  // namespace penduline
