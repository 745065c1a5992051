// SPDX-License-Identifier: Apache-2.0
#include "host/figure/figure_layout.hpp"

#include <catch2/catch.hpp>

#include "host/figure/axis_tics.hpp"

using namespace penduline;

namespace {

constexpr double kWidthPx = 779;

/// Two panels one above the other, with so many names of so many letters over each.
Figure stack(std::size_t names, std::size_t letters) {
  const Panel panel{.curves = std::vector<Curve>(names, Curve{.name = std::string(letters, 'n')}),
                    .key_above = true};
  return {.panels = {panel, panel}, .title = "Title", .stacked = true};
}

Panel over_times(double first, double last) {
  return {.curves = {Curve{.x = {first, last}, .y = {0, 1}}}};
}

}  // namespace

TEST_CASE("Names over a panel stand beside each other as far as they fit, else in rows") {
  const auto shape = [](std::size_t names, std::size_t letters) {
    const KeyShape key = key_shape(stack(names, letters).panels[0], kWidthPx);
    return std::pair(key.columns, key.rows);
  };
  CHECK(shape(0, 0) == std::pair<std::size_t, std::size_t>(1, 1));
  CHECK(shape(3, 20) == std::pair<std::size_t, std::size_t>(3, 1));
  CHECK(shape(6, 20) == std::pair<std::size_t, std::size_t>(3, 2));
  CHECK(shape(4, 30) == std::pair<std::size_t, std::size_t>(2, 2));
  CHECK(shape(6, 60) == std::pair<std::size_t, std::size_t>(1, 6));
}

TEST_CASE("A stack is higher by the rows of its keys, and its panels as high as without") {
  const Figure one_row = stack(2, 10);
  const Figure six_rows = stack(6, 60);
  CHECK(size_of(one_row).height_px == 540);
  CHECK(size_of(six_rows).height_px == 540 + 2 * 5 * 18);
  const StackLayout low = stack_layout(one_row);
  const StackLayout high = stack_layout(six_rows);
  CHECK(low.panel_height_px == Approx(194));
  CHECK(high.panel_height_px == Approx(194));
  CHECK(high.top_px - low.top_px == Approx(5 * 18));
  CHECK(high.spacing_px - low.spacing_px == Approx(5 * 18));
}

TEST_CASE("A name longer than its panel is wide loses its middle, whole letters at a time") {
  CHECK(key_text("short.csv", kWidthPx) == "short.csv");
  CHECK(key_text("äöüäöüäöüäöü.csv", (8 + 10) * kLetterPx) == "äöü…öü.csv");
  CHECK(key_text(std::string(300, 'n') + ": RMS 0.1 deg", kWidthPx).ends_with(": RMS 0.1 deg"));
}

TEST_CASE("Tics stand further apart where their numbers would run into each other") {
  CHECK_FALSE(x_step(over_times(0, 20), kWidthPx));
  CHECK_FALSE(x_step(over_times(300'000, 300'001.5), kWidthPx));
  CHECK(x_step(over_times(1'760'000'000, 1'760'000'001.9), kWidthPx) == 0.5);
  CHECK(x_step(over_times(0, 20), 90) == 10);
  CHECK_FALSE(x_step(over_times(5, 5), kWidthPx));
  CHECK_FALSE(x_step({}, kWidthPx));
}
