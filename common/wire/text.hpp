// SPDX-License-Identifier: Apache-2.0
// Short texts of a fixed size, filled up with zeros.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>

namespace penduline::wire {

/// UTF-8, ended by a zero unless all 16 bytes are used.
using Text = std::array<char, 16>;

/// The text's first 16 bytes.
[[nodiscard]] constexpr Text text_of(std::string_view characters) {
  Text text{};
  std::copy_n(characters.begin(), std::min(characters.size(), text.size()), text.begin());
  return text;
}

/// The characters before the first zero; they live as long as `text` does.
[[nodiscard]] constexpr std::string_view characters_of(const Text& text) {
  const std::string_view all(text.data(), text.size());
  return all.substr(0, all.find('\0'));
}

}  // namespace penduline::wire
