// SPDX-License-Identifier: Apache-2.0
// What the tests of rig files share: a whole rig as text, of which each test changes one line.
#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <string>
#include <string_view>

#include "host/rig_file.hpp"

namespace penduline::test {

/// Two linear sensors and a filter. Lines 1 to 5 are the pendulum, 6 to 8 the disc, 9 to 12 and 13
/// to 16 the sensors, 17 to 19 the filter.
inline constexpr std::string_view kRigText =
    "[pendulum]\n"
    "length_m = 0.3\n"
    "mass_kg = 0.1\n"
    "gravity_m_s2 = 9.8\n"
    "damping_per_s = 0.01\n"
    "[disc]\n"
    "offset_m = 0.02\n"
    "diameter_m = 0.12\n"
    "[[sensor]]\n"
    "name = \"Sx\"\n"
    "position_m = [0.02, 0.0, 0.0]\n"
    "response = { model = \"linear\", gap_at_zero_m = 0.031, slope_m_per_v = -0.006 }\n"
    "[[sensor]]\n"
    "name = \"Sy\"\n"
    "position_m = [0.0, 0.02, 0.0]\n"
    "response = { model = \"linear\", gap_at_zero_m = 0.031, slope_m_per_v = -0.006 }\n"
    "[filter]\n"
    "order = 15\n"
    "cutoff_of_nyquist = 0.15\n";

/// The rig with one line, counted from 1, replaced; "" takes the line out.
[[nodiscard]] inline std::string rig_with(int line, const std::string& replacement) {
  std::string text(kRigText);
  std::size_t begin = 0;
  for (int i = 1; i < line; ++i) {
    begin = text.find('\n', begin) + 1;
  }
  const std::string ended = replacement.empty() ? "" : replacement + "\n";
  return text.replace(begin, text.find('\n', begin) + 1 - begin, ended);
}

/// The error of a rig in the file `rig.toml`; "" where there is none.
[[nodiscard]] inline std::string rig_error(const std::string& text) {
  const auto rig = parse_rig(text, "rig.toml");
  return rig ? "" : rig.error().message;
}

/// The rig with another response of its first sensor, on line 12.
[[nodiscard]] inline std::string rig_with_response(const std::string& table) {
  return rig_with(12, "response = " + table);
}

}  // namespace penduline::test
