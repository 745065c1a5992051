// SPDX-License-Identifier: Apache-2.0
// Taking the addresses of outputs apart.
#include "host/output/output_address.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cstddef>
#include <optional>
#include <utility>

#include "hal/replay/cells.hpp"

namespace penduline {
namespace {

constexpr std::uint16_t kMqttPort = 1883;
constexpr std::uint16_t kMqttTlsPort = 8883;

struct HostAndPort {
  std::string host;
  std::uint16_t port;
};

/// HOST:PORT or, where there is a usual port, HOST.
std::optional<HostAndPort> parse_host(std::string_view text, std::optional<std::uint16_t> usual) {
  std::string_view host = text.substr(0, text.find(':'));
  std::string_view rest = text.substr(host.size());
  if (text.starts_with('[') && text.find(']') != std::string_view::npos) {
    host = text.substr(1, text.find(']') - 1);
    rest = text.substr(host.size() + 2);
  }
  std::optional<std::uint16_t> port = usual;
  if (rest.starts_with(':')) {
    port = parse_number<std::uint16_t>(rest.substr(1));
  } else if (!rest.empty()) {
    return std::nullopt;
  }
  if (host.empty() || host.find('/') != std::string_view::npos || !port || *port == 0) {
    return std::nullopt;
  }
  return HostAndPort{.host = std::string(host), .port = *port};
}

/// The bytes that %XX stand for; none where something else follows a %.
std::optional<std::string> decoded(std::string_view text) {
  constexpr std::size_t kDigits = 2;
  constexpr int kBase = 16;
  std::string bytes;
  while (!text.empty()) {
    if (text.front() != '%') {
      bytes += text.front();
      text.remove_prefix(1);
      continue;
    }
    const std::string_view digits = text.substr(1, kDigits);
    std::uint8_t byte = 0;
    const auto parsed = std::from_chars(digits.data(), digits.data() + digits.size(), byte, kBase);
    if (digits.size() < kDigits || parsed.ptr != digits.data() + kDigits) {
      return std::nullopt;
    }
    bytes += static_cast<char>(byte);
    text.remove_prefix(1 + kDigits);
  }
  return bytes;
}

bool is_topic(std::string_view topic) {
  return !topic.empty() && !topic.ends_with('/') &&
         topic.find_first_of("+#") == std::string_view::npos;
}

/// What stands behind `mqtt://`.
std::optional<MqttAddress> parse_mqtt(std::string_view text, bool tls) {
  const std::size_t slash = text.find('/');
  if (slash == std::string_view::npos) {
    return std::nullopt;
  }
  const std::string_view authority = text.substr(0, slash);
  const std::size_t at = authority.rfind('@');
  const bool named = at != std::string_view::npos;
  const std::string_view credentials = named ? authority.substr(0, at) : std::string_view();
  const std::string_view place = named ? authority.substr(at + 1) : authority;
  const std::string_view user = credentials.substr(0, credentials.find(':'));
  const std::string_view password =
      user.size() < credentials.size() ? credentials.substr(user.size() + 1) : std::string_view();

  const auto host = parse_host(place, tls ? kMqttTlsPort : kMqttPort);
  auto its_topic = decoded(text.substr(slash + 1));
  auto its_user = decoded(user);
  auto its_password = decoded(password);
  if (!host || !its_topic || !is_topic(*its_topic) || !its_user || !its_password ||
      (named && its_user->empty())) {
    return std::nullopt;
  }
  return MqttAddress{
      .name = fmt::format("{}://{}{}", tls ? "mqtts" : "mqtt", place, text.substr(slash)),
      .host = host->host,
      .port = host->port,
      .topic = std::move(*its_topic),
      .user = std::move(*its_user),
      .password = std::move(*its_password),
      .tls = tls};
}

}  // namespace

tl::expected<OutputAddress, Error> parse_output(std::string_view text) {
  constexpr std::string_view kUdp = "udp:";
  constexpr std::string_view kMqtt = "mqtt://";
  constexpr std::string_view kMqtts = "mqtts://";
  if (text.empty()) {
    return failure("found no output, expected a path, -, udp:HOST:PORT or mqtt://HOST/TOPIC");
  }
  if (text.starts_with(kUdp)) {
    auto place = parse_host(text.substr(kUdp.size()), std::nullopt);
    if (!place) {
      return failure(fmt::format("found '{}', expected udp:HOST:PORT", text));
    }
    return UdpAddress{
        .name = std::string(text), .host = std::move(place->host), .port = place->port};
  }
  if (text.starts_with("mqtt:") || text.starts_with("mqtts:")) {
    const bool tls = text.starts_with("mqtts:");
    const std::string_view prefix = tls ? kMqtts : kMqtt;
    auto address = text.starts_with(prefix) ? parse_mqtt(text.substr(prefix.size()), tls)
                                            : std::optional<MqttAddress>();
    if (!address) {
      // What was typed is not shown: it may hold a password.
      return failure(
          fmt::format("found no broker and topic behind {}, expected "
                      "{}[USER[:PASSWORD]@]HOST[:PORT]/TOPIC without + and #",
                      text.substr(0, text.find(':') + 1), prefix));
    }
    return std::move(*address);
  }
  return TextAddress{.path = std::string(text)};
}

}  // namespace penduline
