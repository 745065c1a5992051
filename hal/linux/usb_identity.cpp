// SPDX-License-Identifier: Apache-2.0
// USB identities as text.
#include "hal/linux/usb_identity.hpp"

#include <fmt/format.h>

#include <charconv>

namespace penduline {
namespace {

std::optional<std::uint16_t> hexadecimal(std::string_view text) {
  std::uint16_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, 16);
  return error == std::errc() && !text.empty() && end == text.data() + text.size()
             ? std::optional(value)
             : std::nullopt;
}

}  // namespace

std::string UsbIdentity::text() const {
  return fmt::format("{:04x}:{:04x}{}{}", vendor, product, serial_number.empty() ? "" : ":",
                     serial_number);
}

std::optional<UsbIdentity> parse_usb_identity(std::string_view text) {
  const std::size_t first = text.find(':');
  if (first == std::string_view::npos) {
    return std::nullopt;
  }
  const std::size_t second = text.find(':', first + 1);
  const auto vendor = hexadecimal(text.substr(0, first));
  const auto product = hexadecimal(text.substr(first + 1, second - first - 1));
  const bool has_serial = second != std::string_view::npos;
  if (!vendor || !product || (has_serial && second + 1 == text.size())) {
    return std::nullopt;
  }
  return UsbIdentity{.vendor = *vendor,
                     .product = *product,
                     .serial_number = std::string(has_serial ? text.substr(second + 1) : "")};
}

}  // namespace penduline
