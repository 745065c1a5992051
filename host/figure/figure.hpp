// SPDX-License-Identifier: Apache-2.0
// Figures by gnuplot: curves and points in panels, as a vector drawing or an image.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <tl/expected.hpp>
#include <vector>

#include "hal/error.hpp"

namespace penduline {

enum class CurveStyle {
  kLine,
  kPoints,
  kErrorBars,
  kBand,   ///< the area within `sigma_y` of y, light
  kMarks,  ///< open triangles, for what is not to be overlooked
};

/// One curve; a value that is not finite leaves a hole.
struct Curve {
  std::string name{};  ///< in the key; "": not there
  CurveStyle style = CurveStyle::kLine;
  std::vector<double> x{};
  std::vector<double> y{};
  std::vector<double> sigma_y{};        ///< of kErrorBars and kBand
  std::vector<double> z{};              ///< of a panel in space
  std::optional<std::size_t> colour{};  ///< of the palette; its place in the panel unless given
  std::size_t dash = 0;                 ///< which pattern a line has; 0: none
  double line_width = 1.5;
};

/// The colours of the palette that are no curve's unless asked for.
inline constexpr std::size_t kGrey = 6;
inline constexpr std::size_t kBlack = 7;

/// One pair of axes, or three.
struct Panel {
  std::string title{};
  std::string x_label{};  ///< with its unit: "t / s"
  std::string y_label{};
  std::string z_label{};  ///< given: a panel in space, whose curves have z
  std::vector<Curve> curves{};
  bool equal_scales = false;        ///< a metre as long across as up; in space always: of x and y
  bool logarithmic = false;         ///< both axes
  std::optional<double> y_least{};  ///< where the y axis begins; by the curves unless given
  bool key_above = false;           ///< the key stands over the panel, where it hides no curve
};

/// A drawing's width and height in pixels, a hundred an inch.
struct FigureSize {
  int width_px = 0;
  int height_px = 0;
};

/// Panels beside each other, or one above the other.
struct Figure {
  std::vector<Panel> panels{};
  std::string title{};
  bool stacked = false;              ///< over one x axis, which only the lowest names
  std::optional<FigureSize> size{};  ///< by the number of panels unless given
};

/// Fails where figures cannot be drawn to a file of this name's ending.
[[nodiscard]] tl::expected<void, Error> require_figure_name(const std::string& path);

/// Draws it to `path` by its ending: .svg, .pdf or .png. Fails where the ending is another, the
/// size leaves panels one above the other no room, gnuplot is not installed or the file cannot be
/// written; then what stood there before still does.
[[nodiscard]] tl::expected<void, Error> draw(const Figure& figure, const std::string& path);

}  // namespace penduline
