// SPDX-License-Identifier: Apache-2.0
// Where the web server listens, as it is typed behind --web.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <tl/expected.hpp>

#include "hal/error.hpp"

namespace penduline {

struct WebAddress {
  std::string host = "127.0.0.1";  ///< a name or an address, IPv6 without brackets
  std::uint16_t port = 0;          ///< 0: any that is free
};

/// Reads [ADDR:]PORT. An IPv6 address stands in brackets.
[[nodiscard]] tl::expected<WebAddress, Error> parse_web_address(std::string_view text);

}  // namespace penduline
