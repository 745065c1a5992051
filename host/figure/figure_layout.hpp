// SPDX-License-Identifier: Apache-2.0
// Where a figure's panels and their keys stand, in pixels.
#pragma once

#include <cstddef>
#include <string>
#include <tl/expected.hpp>

#include "hal/error.hpp"
#include "host/figure/figure.hpp"

namespace penduline {

/// As asked for, else by the number of panels and, one above the other, their keys.
[[nodiscard]] FigureSize size_of(const Figure& figure);

/// A key's entries in rows.
struct KeyShape {
  std::size_t columns = 1;
  std::size_t rows = 1;
};

/// As many entries beside each other as fit over a panel.
[[nodiscard]] KeyShape key_shape(const Panel& panel, double width_px);

/// A curve's name, its middle left out where it is longer than a panel is wide.
[[nodiscard]] std::string key_text(const std::string& name, double width_px);

/// How long the axes of panels beside each other are, about.
[[nodiscard]] double panel_width_px(const Figure& figure);

/// Panels one above the other: the margins around them, which hold title, keys and numbers.
struct StackLayout {
  double left_px = 0;
  double right_px = 0;
  double bottom_px = 0;
  double top_px = 0;
  double spacing_px = 0;       ///< between two
  double panel_height_px = 0;  ///< of each one's axes

  /// How far a key stands above its axes.
  static constexpr double kKeyGapPx = 6;
};

[[nodiscard]] StackLayout stack_layout(const Figure& figure);

/// Fails where its size leaves panels one above the other no height.
[[nodiscard]] tl::expected<void, Error> require_room(const Figure& figure);

}  // namespace penduline
