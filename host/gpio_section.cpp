// SPDX-License-Identifier: Apache-2.0
// A line is its name in quotes, or a table of the name and what else is to be said.
#include "host/gpio_section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

namespace penduline {
namespace {

constexpr std::string_view kWords =
    "a line's name in quotes, or { line = \"NAME\", active_low = true }";

GpioLine read_line(const toml::table& table, std::string_view key, TomlSection& section,
                   TomlFindings& findings) {
  GpioLine line;
  if (!table[key].is_table()) {
    line.name = section.text(key, kWords);
  } else {
    TomlSection inner(*section.section(key), fmt::format("[gpio] {}", key), findings);
    line.name = inner.text("line", "a line's name in quotes");
    line.active_low = inner.flag_or("active_low", false);
    inner.complain_of_unknown_keys();
  }
  if (line.name.empty()) {
    section.fail(key, fmt::format("found no name, expected {}", kWords));
  }
  return line;
}

}  // namespace

RigLines read_gpio(const toml::table& table, TomlFindings& findings) {
  RigLines lines;
  TomlSection section(table, "[gpio]", findings);
  for (const GpioKeyDescription& description : kGpioKeys) {
    if (!section.has(description.key)) {
      continue;
    }
    const GpioLine line = read_line(table, description.key, section, findings);
    const auto* const same = std::ranges::find_if(kGpioKeys, [&](const GpioKeyDescription& other) {
      return lines.*other.line && (lines.*other.line)->name == line.name;
    });
    if (same != kGpioKeys.end()) {
      section.fail(description.key, fmt::format("found '{}', which is {} already, expected a line "
                                                "of its own",
                                                line.name, same->key));
    }
    lines.*description.line = line;
  }
  section.complain_of_unknown_keys();
  return lines;
}

}  // namespace penduline
