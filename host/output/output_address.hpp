// SPDX-License-Identifier: Apache-2.0
// Addresses of outputs, as they are typed behind --output.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <variant>

#include "hal/error.hpp"

namespace penduline {

/// A file; "-" is the standard output.
struct TextAddress {
  std::string path;
};

/// udp:HOST:PORT
struct UdpAddress {
  std::string name;  ///< as typed
  std::string host;
  std::uint16_t port = 0;
};

/// mqtt://[USER[:PASSWORD]@]HOST[:PORT]/TOPIC, or mqtts: by TLS
struct MqttAddress {
  std::string name;  ///< as typed, but for the user and the password
  std::string host;
  std::uint16_t port = 0;
  std::string topic;
  std::string user;      ///< "": none
  std::string password;  ///< "": none
  bool tls = false;
};

using OutputAddress = std::variant<TextAddress, UdpAddress, MqttAddress>;

/// Reads an address. What begins with neither `udp:` nor `mqtt:` nor `mqtts:` is a path. An IPv6
/// address stands in brackets; %XX in an mqtt address stands for a byte, as in any URI.
[[nodiscard]] tl::expected<OutputAddress, Error> parse_output(std::string_view text);

}  // namespace penduline
