// SPDX-License-Identifier: Apache-2.0
// Every line of every chip is asked for its name.
#include "hal/linux/gpio_search.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <gpiod.hpp>
#include <system_error>

namespace penduline {
namespace {

namespace fs = std::filesystem;

/// The chips' devices, not the other names that a system gives them by links.
std::vector<std::string> chip_paths() {
  std::vector<std::string> paths;
  std::error_code problem;
  for (const fs::directory_entry& entry : fs::directory_iterator("/dev", problem)) {
    if (entry.path().filename().string().starts_with("gpiochip") &&
        entry.is_character_file(problem) && !entry.is_symlink(problem)) {
      paths.push_back(entry.path());
    }
  }
  std::ranges::sort(paths);
  return paths;
}

void search_chip(const std::string& path, const std::string& name, GpioFindings& findings) {
  const gpiod::chip chip(path, gpiod::chip::OPEN_BY_PATH);
  findings.chips.push_back(chip.name());
  for (unsigned offset = 0; offset < chip.num_lines(); ++offset) {
    if (chip.get_line(offset).name() == name) {
      findings.places.push_back({.chip = chip.name(), .offset = offset});
    }
  }
}

}  // namespace

GpioFindings find_gpio_line(const std::string& name) {
  GpioFindings findings;
  for (const std::string& path : chip_paths()) {
    try {
      search_chip(path, name, findings);
    } catch (const std::system_error& error) {
      findings.unreadable.push_back(fmt::format("{}: {}", path, error.code().message()));
    }
  }
  return findings;
}

tl::expected<GpioPlace, Error> only_place(const std::string& name, const GpioFindings& findings) {
  if (findings.places.size() == 1) {
    return findings.places.front();
  }
  if (findings.places.size() > 1) {
    std::vector<std::string> places;
    for (const GpioPlace& place : findings.places) {
      places.push_back(fmt::format("line {} of {}", place.offset, place.chip));
    }
    return failure(fmt::format("GPIO line '{}': found {}, expected one line of this name", name,
                               fmt::join(places, " and ")));
  }
  if (!findings.unreadable.empty()) {
    return failure(
        fmt::format("GPIO line '{}': {}, expected to find the line there (as a rule the group gpio "
                    "may open chips)",
                    name, fmt::join(findings.unreadable, ", ")));
  }
  if (findings.chips.empty()) {
    return failure(
        fmt::format("GPIO line '{}': found no GPIO chip, expected /dev/gpiochip0 or others", name));
  }
  return failure(fmt::format("GPIO line '{}': not found on {}; gpioinfo lists the lines' names",
                             name, fmt::join(findings.chips, ", ")));
}

}  // namespace penduline
