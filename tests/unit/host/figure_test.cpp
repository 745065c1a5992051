// SPDX-License-Identifier: Apache-2.0
#include "host/figure/figure.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "tests/unit/temporary_folder.hpp"

using namespace penduline;
using penduline::test::TemporaryFolder;

namespace {

Figure two_panels() {
  const Curve line{.name = "it's 'quoted'", .x = {0, 1, NAN, 3}, .y = {0, 2, 1, 6}};
  const Curve points{.name = "points",
                     .style = CurveStyle::kErrorBars,
                     .x = {1, 2},
                     .y = {2, 3},
                     .sigma_y = {0.1, 0.2}};
  const Panel panel{.title = "theta1_rad",
                    .x_label = "t / s",
                    .y_label = "angle / deg",
                    .curves = {line, points}};
  return {.panels = {panel, panel}};
}

std::string contents(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

}  // namespace

TEST_CASE("A figure is drawn as SVG, PDF or PNG by its name's ending") {
  const TemporaryFolder folder;
  const auto begins = [&](const char* name, std::string_view magic) {
    const std::string path = folder.path(name);
    REQUIRE(draw(two_panels(), path));
    return contents(path).starts_with(magic);
  };
  CHECK(begins("f.svg", "<?xml"));
  CHECK(begins("f.pdf", "%PDF"));
  CHECK(begins("f.png", "\x89PNG"));
}

TEST_CASE("Names and labels stand in a figure as they were given") {
  const TemporaryFolder folder;
  const std::string path = folder.path("f.svg");
  REQUIRE(draw(two_panels(), path));
  const std::string svg = contents(path);
  CHECK(svg.find("it's 'quoted'") != std::string::npos);
  CHECK(svg.find("theta1_rad") != std::string::npos);
}

TEST_CASE("A figure of another ending is refused") {
  const auto drawn = draw(two_panels(), "figure.jpg");
  REQUIRE_FALSE(drawn);
  CHECK(drawn.error().message == "figure.jpg: expected a name that ends in .svg, .pdf or .png");
}

TEST_CASE("A figure that cannot be written says so and leaves nothing") {
  const TemporaryFolder folder;
  const std::string path = folder.path("missing/f.svg");
  const auto drawn = draw(two_panels(), path);
  REQUIRE_FALSE(drawn);
  CHECK(drawn.error().message.starts_with(path + ": gnuplot could not draw it: "));
}
