// SPDX-License-Identifier: Apache-2.0
// A board's clock behind a link with delays, and the two plain ways to read it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

#include "host/session/clock_exchange.hpp"

namespace penduline::test {

struct LinkSettings {
  double drift_ppm = 150;
  double jitter_us = 1000;      ///< mean of what each way takes longer, exponentially distributed
  bool jitter_one_way = false;  ///< on the way back only, as of a host that wakes late
  double least_us = 100;        ///< what each way takes at least
  double outliers = 0.1;        ///< share of exchanges that take 100 ms longer on one way
  double warming_ppm = 0;       ///< amplitude of a slow change of the drift, over 20 minutes
  std::uint64_t seed = 1;
};

/// One exchange a second with a board whose clock began 5 s before the host's.
class SimulatedLink {
 public:
  explicit SimulatedLink(const LinkSettings& settings)
      : settings_(settings), random_(settings.seed) {}

  /// What the board's clock says at a time of the host, in us.
  [[nodiscard]] double board_us(double host_us) const {
    constexpr double kPeriodUs = 1200e6;
    const double turn = 2 * std::numbers::pi / kPeriodUs;
    return 5e6 + host_us * (1 + settings_.drift_ppm * 1e-6) +
           settings_.warming_ppm * 1e-6 * (1 - std::cos(turn * host_us)) / turn;
  }
  [[nodiscard]] double drift_ppm(double host_us) const {
    return (board_us(host_us + 1e4) - board_us(host_us - 1e4) - 2e4) / 2e4 * 1e6;
  }

  ClockExchange next() {
    now_us_ += 1e6;
    double there_us = settings_.least_us + (settings_.jitter_one_way ? 0 : jitter());
    double back_us = settings_.least_us + jitter();
    if (uniform() < settings_.outliers) {
      (uniform() < 0.5 ? there_us : back_us) += 1e5;
    }
    return {.sent_us = whole(now_us_),
            .t_us = whole(board_us(now_us_ + there_us)),
            .received_us = whole(now_us_ + there_us + back_us),
            .utc_us = 0};
  }

  /// From 0 up to 1.
  double uniform() { return static_cast<double>(random_() >> 11U) / 9007199254740992.0; }

 private:
  static std::int64_t whole(double us) { return static_cast<std::int64_t>(us); }
  double jitter() { return -settings_.jitter_us * std::log(1 - uniform()); }

  LinkSettings settings_;
  std::mt19937_64 random_;
  double now_us_ = 0;
};

/// The exchanges of the last minute, to which the two references answer.
class LastMinute {
 public:
  void take(const ClockExchange& exchange) {
    kept_.push_back(exchange);
    if (kept_.size() > 60) {
      kept_.erase(kept_.begin());
    }
  }

  /// Host's time by the straight line of least squares through all.
  [[nodiscard]] double least_squares_us(std::int64_t t_us) const {
    double t = 0;
    double offset = 0;
    for (const ClockExchange& e : kept_) {
      t += since_first(e.t_us) / count();
      offset += offset_us(e) / count();
    }
    double tt = 0;
    double to = 0;
    for (const ClockExchange& e : kept_) {
      tt += (since_first(e.t_us) - t) * (since_first(e.t_us) - t);
      to += (since_first(e.t_us) - t) * (offset_us(e) - offset);
    }
    const double slope = tt > 0 ? to / tt : 0;
    return static_cast<double>(t_us) + offset + slope * (since_first(t_us) - t);
  }

  /// Host's time by the exchange of the shortest round trip.
  [[nodiscard]] double shortest_us(std::int64_t t_us) const {
    const auto round_trip = [](const ClockExchange& e) { return e.received_us - e.sent_us; };
    return static_cast<double>(t_us) + offset_us(*std::ranges::min_element(kept_, {}, round_trip));
  }

 private:
  [[nodiscard]] double count() const { return static_cast<double>(kept_.size()); }
  [[nodiscard]] double since_first(std::int64_t t_us) const {
    return static_cast<double>(t_us - kept_.front().t_us);
  }
  static double offset_us(const ClockExchange& e) {
    return static_cast<double>(e.sent_us - e.t_us) +
           static_cast<double>(e.received_us - e.sent_us) / 2;
  }

  std::vector<ClockExchange> kept_;
};

}  // namespace penduline::test
