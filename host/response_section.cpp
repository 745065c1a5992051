// SPDX-License-Identifier: Apache-2.0
// The four response models of the rig file.
#include "host/response_section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace penduline {
namespace {

Response<double> read_linear(TomlSection& section) {
  const LinearResponse<double> model{.gap_at_zero_m = section.number("gap_at_zero_m", kAnyNumber),
                                     .slope_m_per_v = section.number("slope_m_per_v", kAnyNumber)};
  if (model.slope_m_per_v == 0) {
    section.fail("slope_m_per_v", "found 0, expected a slope");
  }
  return {.model = model};
}

Response<double> read_inverse_square(TomlSection& section) {
  return {.model = InverseSquareResponse<double>{.a_v_m2 = section.number("a_v_m2", kAboveZero),
                                                 .b_m = section.number("b_m", kNotNegative),
                                                 .c_v = section.number("c_v", kAnyNumber)}};
}

Response<double> read_polynomial(TomlSection& section) {
  constexpr int kPlaces = 1000;
  PolynomialResponse<double> model;
  const std::vector<double> coefficients =
      section.numbers("coefficients", 2, PolynomialResponse<double>::kMaxCoefficients);
  std::ranges::copy(coefficients, model.coefficient.begin());
  model.count = coefficients.size();
  const std::vector<double> range = section.numbers("range_v", 2, 2);
  model.volts_min = range[0];
  model.volts_max = range[1];
  if (!(range[0] < range[1]) || !model.is_monotone(kPlaces)) {
    section.fail("range_v",
                 "the gap must keep rising or keep falling from the first to the second");
  }
  const auto [nearest, farthest] =
      std::minmax({model.value(model.volts_min), model.value(model.volts_max)});
  return {.model = model, .nearest_m = nearest, .farthest_m = farthest};
}

struct Point {
  double volts;
  double gap_m;
};

/// How many points, counted from the farthest gap inwards, keep rising or keep falling in volts.
std::size_t length_of_branch(const std::vector<Point>& points, std::size_t first) {
  std::size_t last = first + 1;
  const double direction = points[last].volts - points[first].volts;
  while (last + 1 < points.size() &&
         (points[last + 1].volts - points[last].volts) * direction > 0) {
    ++last;
  }
  return direction != 0 ? last - first + 1 : 1;
}

Response<double> read_table(TomlSection& section) {
  const std::vector<double> volts = section.numbers("volts", 2, kMaxCurvePoints);
  const std::vector<double> gaps = section.numbers("gap_m", 2, kMaxCurvePoints);
  if (volts.size() != gaps.size()) {
    section.fail("gap_m", fmt::format("found {} numbers, expected as many as volts has, {}",
                                      gaps.size(), volts.size()));
    return {};
  }
  std::vector<Point> points;
  for (std::size_t i = 0; i < volts.size(); ++i) {
    points.push_back({.volts = volts[i], .gap_m = gaps[i]});
  }
  std::ranges::sort(points, std::ranges::greater{}, &Point::gap_m);
  if (std::ranges::adjacent_find(points, {}, &Point::gap_m) != points.end()) {
    section.fail("gap_m", "the same gap stands there twice");
    return {};
  }
  // From far to near the signal grows up to the peak; what is nearer still only tells that there is
  // a peak.
  const std::size_t usable = length_of_branch(points, 0);
  const bool folds = usable < points.size();
  if (usable < 2 || (folds && usable - 1 + length_of_branch(points, usable - 1) != points.size())) {
    section.fail("volts", "the signal turns round more than once, expected at most one peak");
    return {};
  }
  points.resize(usable);
  const double nearest_m = points.back().gap_m;
  const double farthest_m = points.front().gap_m;
  std::ranges::sort(points, {}, &Point::volts);
  std::vector<double> x;
  std::vector<double> y;
  for (const Point& point : points) {
    x.push_back(point.volts);
    y.push_back(point.gap_m);
  }
  return {.model = TableResponse<double>{MonotoneCubic<double>(x, y)},
          .nearest_m = nearest_m,
          .farthest_m = farthest_m,
          .peak_m = folds ? nearest_m : 0};
}

/// The keys that every model may have.
void read_range(TomlSection& section, Response<double>& response) {
  if (section.has("range_m")) {
    const std::vector<double> range = section.numbers("range_m", 2, 2);
    if (!(range[0] < range[1])) {
      section.fail("range_m", "expected the nearest gap, then the farthest");
    }
    response.nearest_m = range[0];
    response.farthest_m = range[1];
  }
  response.peak_m = section.number_or("peak_m", kNotNegative, response.peak_m);
}

}  // namespace

Response<double> read_response(const toml::table& table, const std::string& path,
                               TomlFindings& findings) {
  constexpr std::string_view kModels =
      "\"linear\", \"table\", \"inverse_square\" or \"polynomial\"";
  TomlSection section(table, path, findings);
  Response<double> response;
  const std::string model = section.text("model", kModels);
  if (model == "linear") {
    response = read_linear(section);
  } else if (model == "table") {
    response = read_table(section);
  } else if (model == "inverse_square") {
    response = read_inverse_square(section);
  } else if (model == "polynomial") {
    response = read_polynomial(section);
  } else {
    section.fail("model", fmt::format("found \"{}\", expected {}", model, kModels));
    return response;
  }
  read_range(section, response);
  section.complain_of_unknown_keys();
  return response;
}

}  // namespace penduline
