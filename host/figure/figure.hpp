// SPDX-License-Identifier: Apache-2.0
// Figures by gnuplot: curves and points in panels, as a vector drawing or an image.
#pragma once

#include <string>
#include <tl/expected.hpp>
#include <vector>

#include "hal/error.hpp"

namespace penduline {

enum class CurveStyle { kLine, kPoints, kErrorBars };

/// One curve; a value that is not finite leaves a hole.
struct Curve {
  std::string name;  ///< in the key; "": not there
  CurveStyle style = CurveStyle::kLine;
  std::vector<double> x;
  std::vector<double> y;
  std::vector<double> sigma_y{};  ///< of kErrorBars
};

/// One pair of axes.
struct Panel {
  std::string title;
  std::string x_label;  ///< with its unit: "t / s"
  std::string y_label;
  std::vector<Curve> curves;
  bool equal_scales = false;  ///< a metre as long across as up
};

/// Panels beside each other.
struct Figure {
  std::vector<Panel> panels;
};

/// Draws it to `path` by its ending: .svg, .pdf or .png. Fails where the ending is another, gnuplot
/// is not installed or the file cannot be written; then there is no file.
[[nodiscard]] tl::expected<void, Error> draw(const Figure& figure, const std::string& path);

}  // namespace penduline
