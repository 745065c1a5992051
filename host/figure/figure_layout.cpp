// SPDX-License-Identifier: Apache-2.0
// Sizes by the number of panels, and of the names over them.
#include "host/figure/figure_layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/figure/axis_tics.hpp"

namespace penduline {
namespace {

constexpr int kPanelWidthPx = 620;
constexpr int kPanelHeightPx = 480;
constexpr int kStackWidthPx = 900;
constexpr int kStackedHeightPx = 230;
constexpr int kKeyRowPx = 18;
constexpr double kSamplePx = 8 * kLetterPx;  // a line's sample and what is about it
constexpr double kStackLeftPx = 96;
constexpr double kStackRightPx = 25;

bool continues_letter(char byte) {
  return (static_cast<unsigned char>(byte) & 0xC0U) == 0x80U;
}

std::size_t letters_in(const std::string& text) {
  return text.size() - static_cast<std::size_t>(std::ranges::count_if(text, continues_letter));
}

/// Where the letter with this number begins.
std::size_t letter_at(const std::string& text, std::size_t number) {
  std::size_t at = 0;
  for (std::size_t seen = 0; at < text.size(); ++at) {
    if (!continues_letter(text[at]) && seen++ == number) {
      break;
    }
  }
  return at;
}

/// The most rows that a key of the figure's has; at least one.
int key_rows(const Figure& figure, double width_px) {
  std::size_t rows = 1;
  for (const Panel& panel : figure.panels) {
    rows = std::max(rows, key_shape(panel, width_px).rows);
  }
  return static_cast<int>(rows);
}

}  // namespace

FigureSize size_of(const Figure& figure) {
  const auto count = static_cast<int>(figure.panels.size());
  if (figure.size) {
    return *figure.size;
  }
  if (!figure.stacked) {
    return {.width_px = kPanelWidthPx * count, .height_px = kPanelHeightPx};
  }
  const int more_rows = key_rows(figure, kStackWidthPx - kStackLeftPx - kStackRightPx) - 1;
  return {.width_px = kStackWidthPx,
          .height_px = (kStackedHeightPx + more_rows * kKeyRowPx) * count + kPanelHeightPx / 6};
}

KeyShape key_shape(const Panel& panel, double width_px) {
  std::size_t entries = 0;
  std::size_t longest = 0;
  for (const Curve& curve : panel.curves) {
    entries += curve.name.empty() ? 0U : 1U;
    longest = std::max(longest, letters_in(key_text(curve.name, width_px)));
  }
  entries = std::max<std::size_t>(entries, 1);
  const double entry_px = kSamplePx + static_cast<double>(longest) * kLetterPx;
  const auto fitting = static_cast<std::size_t>(std::max(width_px / entry_px, 1.0));
  const std::size_t rows = (entries + fitting - 1) / fitting;
  return {.columns = (entries + rows - 1) / rows, .rows = rows};
}

std::string key_text(const std::string& name, double width_px) {
  constexpr std::size_t kFewest = 8;
  const auto most = std::max(
      static_cast<std::size_t>(std::max((width_px - kSamplePx) / kLetterPx, 0.0)), kFewest);
  const std::size_t letters = letters_in(name);
  if (letters <= most) {
    return name;
  }
  const std::size_t after = 2 * most / 3;  // numbers of files, and what a curve is, stand last
  return name.substr(0, letter_at(name, most - 1 - after)) + "…" +
         name.substr(letter_at(name, letters - after));
}

double panel_width_px(const Figure& figure) {
  constexpr double kNumbersPx = 80;  // of the y axis, and its label
  const double width_px = size_of(figure).width_px;
  return figure.stacked ? width_px - kStackLeftPx - kStackRightPx
                        : width_px / static_cast<double>(figure.panels.size()) - kNumbersPx;
}

StackLayout stack_layout(const Figure& figure) {
  constexpr double kTitlePx = 22;
  const auto count = static_cast<double>(figure.panels.size());
  const double more_rows_px = kKeyRowPx * (key_rows(figure, panel_width_px(figure)) - 1);
  StackLayout layout{.left_px = kStackLeftPx,
                     .right_px = kStackRightPx,
                     .bottom_px = 52,
                     .top_px = 30 + (figure.title.empty() ? 0 : kTitlePx) + more_rows_px,
                     .spacing_px = 48 + more_rows_px};
  layout.panel_height_px = (size_of(figure).height_px - layout.bottom_px - layout.top_px -
                            (count - 1) * layout.spacing_px) /
                           count;
  return layout;
}

tl::expected<void, Error> require_room(const Figure& figure) {
  constexpr double kLeastPx = 40;
  if (!figure.stacked) {
    return {};
  }
  const auto [width_px, height_px] = size_of(figure);
  const double lacking_px =
      (kLeastPx - stack_layout(figure).panel_height_px) * static_cast<double>(figure.panels.size());
  if (lacking_px > 0) {
    return failure(fmt::format(
        "found a size of {}x{} pixels, expected a height of {} or more: panels one above the "
        "other, and their keys, have no room",
        width_px, height_px, height_px + static_cast<int>(std::ceil(lacking_px))));
  }
  return {};
}

}  // namespace penduline
