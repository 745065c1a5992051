// SPDX-License-Identifier: Apache-2.0
// Looks for a GPIO line by its name, on all chips.
#pragma once

#include <string>
#include <tl/expected.hpp>
#include <vector>

#include "hal/error.hpp"

namespace penduline {

struct GpioPlace {
  std::string chip;  ///< "gpiochip0"
  unsigned offset = 0;

  bool operator==(const GpioPlace&) const = default;
};

/// Where a name was looked for, and where it was found.
struct GpioFindings {
  std::vector<std::string> chips{};       ///< that were searched: "gpiochip0"
  std::vector<std::string> unreadable{};  ///< "/dev/gpiochip1: Permission denied"
  std::vector<GpioPlace> places{};
};

/// Looks on every chip that this program may open.
[[nodiscard]] GpioFindings find_gpio_line(const std::string& name);

/// The one place that was found. Fails, saying what was found and expected, where there is none or
/// more than one.
[[nodiscard]] tl::expected<GpioPlace, Error> only_place(const std::string& name,
                                                        const GpioFindings& findings);

}  // namespace penduline
