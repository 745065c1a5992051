// SPDX-License-Identifier: Apache-2.0
// A figure in gnuplot's language: terminal, panels, curves.
#include "host/figure/figure_script.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <string_view>

#include "host/figure/axis_tics.hpp"
#include "host/figure/figure_layout.hpp"

namespace penduline {
namespace {

std::string gnuplot_string(std::string_view text) {
  std::string result = "'";
  for (const char c : text) {
    result += c == '\'' ? "''" : std::string(1, c == '\n' ? ' ' : c);
  }
  return result + "'";
}

void put_rows(std::string& script, const Curve& curve, bool in_space) {
  for (std::size_t i = 0; i < curve.x.size(); ++i) {
    auto out = std::back_inserter(script);
    const double x = curve.x[i];
    const double y = curve.y[i];
    if (!std::isfinite(x) || !std::isfinite(y) || (in_space && !std::isfinite(curve.z[i]))) {
      // Gnuplot lifts its pen; in space an empty line would begin another line of a grid.
      script += in_space ? "NaN NaN NaN\n" : "\n";
    } else if (in_space) {
      fmt::format_to(out, "{} {} {}\n", x, y, curve.z[i]);
    } else if (curve.style == CurveStyle::kErrorBars) {
      fmt::format_to(out, "{} {} {}\n", x, y, curve.sigma_y[i]);
    } else if (curve.style == CurveStyle::kBand) {
      fmt::format_to(out, "{} {} {}\n", x, y - curve.sigma_y[i], y + curve.sigma_y[i]);
    } else {
      fmt::format_to(out, "{} {}\n", x, y);
    }
  }
}

/// How a curve looks, but for its colour.
std::string style_of(const Curve& curve) {
  switch (curve.style) {
    case CurveStyle::kLine:
      return fmt::format("lines linewidth {} dashtype {}", curve.line_width, curve.dash + 1);
    case CurveStyle::kPoints:
      return "points pointtype 7 pointsize 0.4";
    case CurveStyle::kBand:
      return "filledcurves fillstyle transparent solid 0.3 noborder";
    case CurveStyle::kMarks:
      return "points pointtype 8 pointsize 0.9";
    case CurveStyle::kErrorBars:
      break;
  }
  return "yerrorbars pointtype 7 pointsize 0.4";
}

/// The columns that a curve's style needs said.
std::string_view columns_of(const Curve& curve) {
  return curve.style == CurveStyle::kBand ? " using 1:2:3" : "";
}

/// A box about paths in space, as deep as it is wide, whose floor is at the lowest tic.
void put_box(std::string& script, const Panel& panel) {
  double extent = 0;
  for (const Curve& curve : panel.curves) {
    for (const auto* values : {&curve.x, &curve.y}) {
      for (const double value : *values) {
        extent = std::isfinite(value) ? std::max(extent, std::abs(value)) : extent;
      }
    }
  }
  constexpr double kRoom = 1.1;
  const double end = extent > 0 ? kRoom * extent : 1;
  for (const char axis : {'x', 'y'}) {
    fmt::format_to(std::back_inserter(script), "set {0}range [{1}:{2}]\nset {0}tics {3}\n", axis,
                   -end, end, round_step(end / 1.5));
  }
  fmt::format_to(std::back_inserter(script),
                 "set border 895\nset xyplane 0\nset view 62,35,1,1.15\n"
                 "set xlabel offset 0,-0.5\nset ylabel offset 1,-0.5\n"
                 "set zlabel {} rotate parallel offset -1.5,0\n",
                 gnuplot_string(panel.z_label));
}

/// The key of a panel: as wide as the panel in a stack, whose layout has room for its rows.
void put_key(std::string& script, const Figure& figure, const Panel& panel) {
  if (!panel.key_above) {
    script += "set key inside right top vertical samplen 4\n";
  } else if (!figure.stacked) {
    script += "set key outside above right maxcols 1 samplen 2.5\n";
  } else {
    fmt::format_to(std::back_inserter(script),
                   "set key at graph 1,{} right bottom horizontal maxcols {} samplen 2.5\n",
                   1 + StackLayout::kKeyGapPx / stack_layout(figure).panel_height_px,
                   key_shape(panel, panel_width_px(figure)).columns);
  }
}

void put_axes(std::string& script, const Figure& figure, const Panel& panel) {
  const auto out = std::back_inserter(script);
  fmt::format_to(out, "set title {}\nset xlabel {}\nset ylabel {}\n", gnuplot_string(panel.title),
                 gnuplot_string(panel.x_label), gnuplot_string(panel.y_label));
  put_key(script, figure, panel);
  if (panel.y_least) {
    fmt::format_to(out, "set yrange [{}:]\n", *panel.y_least);
  }
  if (!panel.z_label.empty()) {
    put_box(script, panel);
    return;
  }
  if (panel.logarithmic) {
    script += "set logscale xy\nset format '%g'\n";
  } else {
    const auto step = x_step(panel, panel_width_px(figure));
    fmt::format_to(out, "set format x '{}'\nset xtics {}\n", kXFormat,
                   step ? fmt::format("{}", *step) : "autofreq");
  }
  script += panel.equal_scales ? "set size ratio -1\n" : "set size noratio\n";
}

void put_panel(std::string& script, const Figure& figure, const Panel& panel) {
  // Colours that the colour-blind tell apart (Okabe and Ito), grey and black.
  constexpr std::array<std::string_view, kBlack + 1> kColours = {
      "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#999999", "#000000"};
  const bool in_space = !panel.z_label.empty();
  for (std::size_t i = 0; i < panel.curves.size(); ++i) {
    fmt::format_to(std::back_inserter(script), "$curve{} << END\n", i);
    put_rows(script, panel.curves[i], in_space);
    script += "END\n";
  }
  put_axes(script, figure, panel);
  const double width_px = panel_width_px(figure);
  script += in_space ? "splot " : "plot ";
  for (std::size_t i = 0; i < panel.curves.size(); ++i) {
    const Curve& curve = panel.curves[i];
    fmt::format_to(
        std::back_inserter(script), "{}$curve{}{} with {} linecolor rgb '{}' {}",
        i == 0 ? "" : ", ", i, columns_of(curve), style_of(curve),
        kColours[curve.colour.value_or(i % kGrey)],
        curve.name.empty() ? "notitle" : "title " + gnuplot_string(key_text(curve.name, width_px)));
  }
  script += '\n';
}

/// Panels one above the other: axes of one length, labels at one distance, however wide the numbers
/// are.
void put_stack(std::string& script, const Figure& figure) {
  const auto [width_px, height_px] = size_of(figure);
  const StackLayout layout = stack_layout(figure);
  const auto across = [width = width_px](double pixels) { return pixels / width; };
  const auto up = [height = height_px](double pixels) { return pixels / height; };
  fmt::format_to(std::back_inserter(script),
                 "set multiplot layout {},1 title {} margins {},{},{},{} spacing 0,{}\n",
                 figure.panels.size(), gnuplot_string(figure.title), across(layout.left_px),
                 1 - across(layout.right_px), up(layout.bottom_px), 1 - up(layout.top_px),
                 up(layout.spacing_px));
  script += "set autoscale xfix\n";
  for (std::size_t i = 0; i < figure.panels.size(); ++i) {
    Panel panel = figure.panels[i];
    fmt::format_to(std::back_inserter(script),
                   "set label 1 {} at screen {}, graph 0.5 center rotate\n",
                   gnuplot_string(panel.y_label), across(20));
    panel.y_label.clear();
    if (i + 1 < figure.panels.size()) {
      panel.x_label.clear();
    }
    put_panel(script, figure, panel);
  }
}

}  // namespace

std::optional<std::string> terminal_for(const Figure& figure, const std::string& path) {
  const std::string ending = std::filesystem::path(path).extension().string();
  const auto [width_px, height_px] = size_of(figure);
  if (ending == ".svg") {
    return fmt::format("svg size {},{} font 'sans,12' background 'white'", width_px, height_px);
  }
  if (ending == ".png") {
    return fmt::format("pngcairo size {},{} font 'sans,11'", width_px, height_px);
  }
  if (ending == ".pdf") {
    constexpr double kPerInch = 100;
    return fmt::format("pdfcairo size {:.2f},{:.2f} font 'sans,11'", width_px / kPerInch,
                       height_px / kPerInch);
  }
  return std::nullopt;
}

std::string script_of(const Figure& figure, const std::string& terminal) {
  std::string script = fmt::format("set encoding utf8\nset terminal {} noenhanced\n", terminal);
  script += "set grid xtics ytics ztics linetype 1 linecolor rgb '#dddddd'\nset tics nomirror\n";
  if (figure.stacked) {
    put_stack(script, figure);
  } else {
    fmt::format_to(std::back_inserter(script), "set multiplot layout 1,{} title {}\n",
                   figure.panels.size(), gnuplot_string(figure.title));
    for (const Panel& panel : figure.panels) {
      put_panel(script, figure, panel);
    }
  }
  return script + "unset multiplot\n";
}

}  // namespace penduline
