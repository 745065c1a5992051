// SPDX-License-Identifier: Apache-2.0
// Responses: the curves that turn a sensor's volts into the gap that it sees, and back.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <variant>

#include "common/bisection.hpp"
#include "common/flags.hpp"
#include "common/monotone_cubic.hpp"

namespace penduline {

/// gap = gap_at_zero_m + slope_m_per_v * volts (method.md eq. 15).
template <class Scalar>
struct LinearResponse {
  Scalar gap_at_zero_m;
  Scalar slope_m_per_v;

  [[nodiscard]] std::optional<Scalar> gap_m(Scalar volts) const {
    return gap_at_zero_m + slope_m_per_v * volts;
  }
  [[nodiscard]] Scalar slope(Scalar /*volts*/) const { return slope_m_per_v; }
  [[nodiscard]] Scalar volts(Scalar gap_m) const { return (gap_m - gap_at_zero_m) / slope_m_per_v; }
};

/// A monotone cubic through calibrated points, gap over volts (method.md eq. 16).
template <class Scalar>
struct TableResponse {
  MonotoneCubic<Scalar> gap_over_volts;

  [[nodiscard]] std::optional<Scalar> gap_m(Scalar volts) const { return gap_over_volts(volts); }
  [[nodiscard]] Scalar slope(Scalar volts) const { return gap_over_volts.slope(volts); }
  [[nodiscard]] Scalar volts(Scalar gap_m) const { return gap_over_volts.inverse(gap_m); }
};

/// volts = a / (gap + b)^2 + c (method.md eq. 17). A signal at or below c belongs to no gap.
template <class Scalar>
struct InverseSquareResponse {
  Scalar a_v_m2;
  Scalar b_m;
  Scalar c_v;

  [[nodiscard]] std::optional<Scalar> gap_m(Scalar volts) const {
    if (volts <= c_v) {
      return std::nullopt;
    }
    return std::sqrt(a_v_m2 / (volts - c_v)) - b_m;
  }
  [[nodiscard]] Scalar slope(Scalar volts) const {
    return -std::sqrt(a_v_m2 / (volts - c_v)) / (2 * (volts - c_v));
  }
  [[nodiscard]] Scalar volts(Scalar gap_m) const {
    return a_v_m2 / ((gap_m + b_m) * (gap_m + b_m)) + c_v;
  }
};

/// gap = sum of coefficient[i] * volts^i, monotone over [volts_min, volts_max] (method.md eq. 18).
template <class Scalar>
struct PolynomialResponse {
  static constexpr std::size_t kMaxCoefficients = 8;

  std::array<Scalar, kMaxCoefficients> coefficient{};
  std::size_t count = 0;
  Scalar volts_min = 0;
  Scalar volts_max = 0;

  [[nodiscard]] std::optional<Scalar> gap_m(Scalar volts) const { return value(volts); }

  [[nodiscard]] Scalar slope(Scalar volts) const {
    Scalar sum = 0;
    for (std::size_t i = count; i-- > 1;) {
      sum = sum * volts + static_cast<Scalar>(i) * coefficient[i];
    }
    return sum;
  }

  /// The volts in [volts_min, volts_max] that give the gap, or the nearer end where none do.
  [[nodiscard]] Scalar volts(Scalar gap_m) const {
    const bool rising = value(volts_max) > value(volts_min);
    return bisect(volts_min, volts_max,
                  [&](Scalar volts) { return (value(volts) > gap_m) == rising; });
  }

  /// Whether the gap keeps rising or keeps falling over the range, by its values at so many places.
  [[nodiscard]] bool is_monotone(int places) const {
    const Scalar step = (volts_max - volts_min) / static_cast<Scalar>(places);
    const bool rising = value(volts_max) > value(volts_min);
    Scalar before = value(volts_min);
    for (int i = 1; i <= places; ++i) {
      const Scalar here = value(volts_min + static_cast<Scalar>(i) * step);
      if (!std::isfinite(here) || !(rising ? here > before : here < before)) {
        return false;
      }
      before = here;
    }
    return true;
  }

  /// The polynomial's value in metres.
  [[nodiscard]] Scalar value(Scalar volts) const {
    Scalar sum = 0;
    for (std::size_t i = count; i-- > 0;) {
      sum = sum * volts + coefficient[i];
    }
    return sum;
  }
};

/// The gap that a signal means, and what speaks against it.
template <class Scalar>
struct GapReading {
  std::optional<Scalar> gap_m;  ///< none where the response has no gap for the signal
  Flags flags = 0;              ///< kOutOfRange, kFolded
};

/// One sensor's response with the range of gaps in which it holds.
template <class Scalar>
struct Response {
  using Model = std::variant<LinearResponse<Scalar>, TableResponse<Scalar>,
                             InverseSquareResponse<Scalar>, PolynomialResponse<Scalar>>;

  Model model;
  Scalar nearest_m = 0;
  Scalar farthest_m = std::numeric_limits<Scalar>::infinity();
  /// The gap of the strongest signal; nearer than it the signal falls again. 0: no such peak known.
  Scalar peak_m = 0;

  /// Signals of gaps up to a quarter beyond the peak's are too near to it to tell its sides apart.
  static constexpr Scalar kPeakMargin = Scalar(1.25);

  /// The gap for a signal. Outside the range the model's continuation, flagged.
  [[nodiscard]] GapReading<Scalar> read(Scalar volts) const {
    GapReading<Scalar> reading{
        .gap_m = std::visit([&](const auto& curve) { return curve.gap_m(volts); }, model)};
    if (!reading.gap_m || *reading.gap_m < nearest_m || *reading.gap_m > farthest_m ||
        is_beyond_model(volts)) {
      reading.flags |= flag::kOutOfRange;
    }
    if (reading.gap_m && peak_m > 0 && *reading.gap_m < kPeakMargin * peak_m) {
      reading.flags |= flag::kFolded;
    }
    return reading;
  }

  /// How fast the gap changes with the signal, in metres per volt, where there is a gap for it.
  [[nodiscard]] Scalar slope_m_per_v(Scalar volts) const {
    return std::visit([&](const auto& curve) { return curve.slope(volts); }, model);
  }

  /// The signal for a gap within the range, in volts.
  [[nodiscard]] Scalar volts(Scalar gap_m) const {
    return std::visit([&](const auto& curve) { return curve.volts(gap_m); }, model);
  }

 private:
  /// Whether the model itself holds for a range of volts only: a polynomial may turn round past its
  /// range and come back to gaps that look good.
  [[nodiscard]] bool is_beyond_model(Scalar volts) const {
    const auto* polynomial = std::get_if<PolynomialResponse<Scalar>>(&model);
    return polynomial != nullptr &&
           (volts < polynomial->volts_min || volts > polynomial->volts_max);
  }
};

}  // namespace penduline
