// SPDX-License-Identifier: Apache-2.0
// Reading URIs.
#include "host/source/source_uri.hpp"

#include <fmt/format.h>

#include <charconv>
#include <optional>

namespace penduline {
namespace {

/// What follows on `prefix`, if the text begins with it.
std::optional<std::string_view> after(std::string_view text, std::string_view prefix) {
  return text.starts_with(prefix) ? std::optional(text.substr(prefix.size())) : std::nullopt;
}

tl::expected<SourceUri, Error> parse_serial(std::string_view rest) {
  constexpr std::string_view kBaud = "?baud=";
  SourceUri uri;
  uri.kind = SourceUri::Kind::kSerial;
  const std::size_t query = rest.find('?');
  uri.path = rest.substr(0, query);
  if (query == std::string_view::npos) {
    return uri;
  }
  const auto digits = after(rest.substr(query), kBaud).value_or("");
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), uri.baud);
  if (digits.empty() || error != std::errc() || end != digits.data() + digits.size()) {
    return failure(fmt::format("found '{}', expected ?baud= and a number", rest.substr(query)));
  }
  return uri;
}

}  // namespace

tl::expected<SourceUri, Error> parse_uri(std::string_view text) {
  using Kind = SourceUri::Kind;
  SourceUri uri;
  if (text == "sim:") {
    uri.kind = Kind::kSimulation;
  } else if (text == "auto") {
    uri.kind = Kind::kAuto;
  } else if (const auto number = after(text, "auto:"); number && !number->empty()) {
    uri.kind = Kind::kAuto;
    uri.serial_number = *number;
  } else if (const auto path = after(text, "file:"); path && !path->empty()) {
    uri.kind = Kind::kRecording;
    uri.path = *path;
  } else if (const auto port = after(text, "serial:"); port && !port->empty()) {
    return parse_serial(*port);
  } else if (const auto device = after(text, "usb:")) {
    const auto identity = parse_usb_identity(*device);
    if (!identity) {
      return failure(
          fmt::format("found '{}', expected usb:VID:PID[:SERIAL], the numbers in "
                      "hexadecimal, as in usb:1209:0001",
                      text));
    }
    uri.kind = Kind::kUsb;
    uri.usb = *identity;
  } else {
    return failure(fmt::format("found '{}', expected {}", text, kSourceForms));
  }
  return uri;
}

}  // namespace penduline
