// SPDX-License-Identifier: Apache-2.0
#include "host/figure/figure.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "tests/unit/host/small_disk.hpp"
#include "tests/unit/temporary_folder.hpp"

using namespace penduline;
using penduline::test::SmallDisk;
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

TEST_CASE("Panels one above the other name their x axis once, at one width") {
  const TemporaryFolder folder;
  const std::string path = folder.path("f.svg");
  Figure figure = two_panels();
  figure.stacked = true;
  figure.title = "Both";
  figure.size = FigureSize{.width_px = 700, .height_px = 500};
  REQUIRE(draw(figure, path));
  const std::string svg = contents(path);
  const auto count = [&](const std::string& text) {
    std::size_t found = 0;
    for (std::size_t at = svg.find(text); at != std::string::npos; at = svg.find(text, at + 1)) {
      ++found;
    }
    return found;
  };
  CHECK(count("<text>t / s</text>") == 1);
  CHECK(count("<text>angle / deg</text>") == 2);
  CHECK(count("<text>Both</text>") == 1);
  CHECK(svg.find("width=\"700\" height=\"500\"") != std::string::npos);
}

TEST_CASE("A band is an area, broken where its curve is") {
  const TemporaryFolder folder;
  const std::string path = folder.path("f.svg");
  const Curve band{.style = CurveStyle::kBand,
                   .x = {0, 1, 2, NAN, 4, 5},
                   .y = {1, 2, 1, NAN, 2, 1},
                   .sigma_y = {0.1, 0.2, 0.1, NAN, 0.1, 0.1}};
  REQUIRE(draw({.panels = {{.curves = {band}}}}, path));
  const std::string svg = contents(path);
  const std::size_t first = svg.find("<polygon");
  REQUIRE(first != std::string::npos);
  const std::size_t second = svg.find("<polygon", first + 1);
  REQUIRE(second != std::string::npos);
  CHECK(svg.find("<polygon", second + 1) == std::string::npos);
}

TEST_CASE("A panel in space names all three axes") {
  const TemporaryFolder folder;
  const std::string path = folder.path("f.svg");
  const Curve curve{.name = "path", .x = {0, 1, NAN, 3}, .y = {0, 2, 1, 6}, .z = {5, 6, 7, 8}};
  REQUIRE(draw(
      {.panels =
           {{.x_label = "x / mm", .y_label = "y / mm", .z_label = "z / mm", .curves = {curve}}}},
      path));
  const std::string svg = contents(path);
  for (const char* label : {"x / mm", "y / mm", "z / mm"}) {
    CHECK(svg.find(label) != std::string::npos);
  }
}

TEST_CASE("A path in space is broken where it says so, whatever its parts' lengths") {
  const TemporaryFolder folder;
  const std::string path = folder.path("f.svg");
  const Curve curve{.x = {0, 1, NAN, 2, 3}, .y = {0, 2, NAN, 1, 6}, .z = {5, 6, NAN, 7, 8}};
  REQUIRE(draw({.panels = {{.z_label = "z / mm", .curves = {curve}}}}, path));
  const std::string svg = contents(path);
  const std::size_t begin = svg.find("gnuplot_plot_1");
  const std::string drawn = svg.substr(begin, svg.find("\n\t</g>", begin) - begin);
  CHECK(std::ranges::count(drawn, 'M') == 2);
  CHECK(std::ranges::count(drawn, 'L') == 2);
}

TEST_CASE("Times stand at the tics with all their digits") {
  const TemporaryFolder folder;
  const std::string path = folder.path("f.svg");
  const Curve curve{.x = {300'000, 300'001.5}, .y = {0, 1}};
  REQUIRE(draw({.panels = {{.curves = {curve}}}, .stacked = true}, path));
  const std::string svg = contents(path);
  CHECK(svg.find(">300000<") != std::string::npos);
  CHECK(svg.find(">300000.6<") != std::string::npos);
}

TEST_CASE("A figure on a full disk says so and leaves what was there") {
  const TemporaryFolder folder;
  const std::string path = folder.write("f.svg", "before");
  {
    const SmallDisk disk(6000);
    const auto drawn = draw(two_panels(), path);
    REQUIRE_FALSE(drawn);
    CHECK(drawn.error().message == path + ".part: File too large");
  }
  {
    const SmallDisk disk(500);  // less than the script
    const auto drawn = draw(two_panels(), path);
    REQUIRE_FALSE(drawn);
    CHECK(drawn.error().message == path + ": no room for a temporary file");
  }
  CHECK(contents(path) == "before");
  CHECK_FALSE(std::filesystem::exists(path + ".part"));
}

TEST_CASE("A figure without room for its panels is refused") {
  Figure figure = two_panels();
  figure.stacked = true;
  figure.size = FigureSize{.width_px = 500, .height_px = 200};
  const auto drawn = draw(figure, "f.svg");
  REQUIRE_FALSE(drawn);
  CHECK(drawn.error().message ==
        "f.svg: found a size of 500x200 pixels, expected a height of 210 or more: panels one above "
        "the other, and their keys, have no room");
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
  CHECK(drawn.error().message == path + ".part: No such file or directory");
}
