// SPDX-License-Identifier: Apache-2.0
// Taking an address apart at its last colon.
#include "host/web/web_address.hpp"

#include <fmt/format.h>

#include "hal/replay/cells.hpp"

namespace penduline {

tl::expected<WebAddress, Error> parse_web_address(std::string_view text) {
  const auto wrong = [&] {
    return failure(fmt::format(
        "found '{}', expected [ADDR:]PORT such as 8080, 0.0.0.0:8080 or [::]:8080, PORT being 0 to "
        "65535 (0: any that is free)",
        text));
  };
  WebAddress address;
  std::string_view port = text;
  if (const std::size_t colon = text.rfind(':'); colon != std::string_view::npos) {
    std::string_view host = text.substr(0, colon);
    port = text.substr(colon + 1);
    if (host.starts_with('[') && host.ends_with(']')) {
      host = host.substr(1, host.size() - 2);
    } else if (host.find(':') != std::string_view::npos) {
      return wrong();
    }
    if (host.empty()) {
      return wrong();
    }
    address.host = host;
  }
  const auto number = parse_number<std::uint16_t>(port);
  if (!number) {
    return wrong();
  }
  address.port = *number;
  return address;
}

}  // namespace penduline
