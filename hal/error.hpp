// SPDX-License-Identifier: Apache-2.0
// An error for a person to read.
#pragma once

#include <algorithm>
#include <string>
#include <tl/expected.hpp>
#include <utility>

namespace penduline {

/// One line that names the file or device, the place, the value found and what was expected.
struct Error {
  std::string message;
};

/// A message with '?' for the control characters that a file's text may bring into it.
[[nodiscard]] inline std::string one_line(std::string message) {
  std::ranges::replace_if(
      message, [](char c) { return static_cast<unsigned char>(c) < ' '; }, '?');
  return message;
}

/// The failed outcome of a function that returns `tl::expected<..., Error>`.
[[nodiscard]] inline tl::unexpected<Error> failure(std::string message) {
  return tl::unexpected(Error{one_line(std::move(message))});
}

}  // namespace penduline
