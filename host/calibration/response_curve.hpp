// SPDX-License-Identifier: Apache-2.0
// Curves of signal over gap whose numbers a fit looks for.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "common/response.hpp"

namespace penduline {

enum class CurveKind {
  /// ln(volts) is a polynomial of the gap: whatever falls smoothly. It becomes a `table`.
  kLogPolynomial,
  kInverseSquare,
};

/// The gaps in which a response is to hold.
struct GapRange {
  double nearest_m = 0;
  double farthest_m = 0;
};

/// A curve of one kind over a range of gaps. Its numbers stand in the order of `names`.
class ResponseCurve {
 public:
  /// `degree`, 1 to 8, is the log polynomial's.
  ResponseCurve(CurveKind kind, const GapRange& range, std::size_t degree)
      : kind_(kind), range_(range), degree_(degree) {}

  [[nodiscard]] std::size_t size() const {
    return kind_ == CurveKind::kLogPolynomial ? degree_ + 1 : 3;
  }
  /// What each number is called, with its unit.
  [[nodiscard]] std::vector<std::string> names() const;
  /// How far each may well be off in a sensor like the one that the search starts from.
  [[nodiscard]] std::vector<double> spreads() const;

  [[nodiscard]] double volts(std::span<const double> numbers, double gap_m) const;

  /// The numbers that come nearest to signals above 0 at given gaps, equally weighted in ln(volts).
  [[nodiscard]] std::vector<double> nearest_to(std::span<const double> gap_m,
                                               std::span<const double> volts) const;

  /// The curve as a rig's response, which holds in `range`.
  [[nodiscard]] Response<double> response(std::span<const double> numbers, const GapRange& range,
                                          double peak_m) const;

 private:
  [[nodiscard]] double place(double gap_m) const;

  CurveKind kind_;
  GapRange range_;
  std::size_t degree_;
};

/// Whether the signal keeps falling over the range, by so many places.
[[nodiscard]] bool keeps_falling(const ResponseCurve& curve, std::span<const double> numbers,
                                 const GapRange& range);

}  // namespace penduline
