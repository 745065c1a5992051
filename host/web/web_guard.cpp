// SPDX-License-Identifier: Apache-2.0
// Host, Origin, header and token, in this order.
#include "host/web/web_guard.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <random>

namespace penduline {
namespace {

using Address = boost::asio::ip::address;

/// An address as it compares: one of IPv4 is one, also where it comes through IPv6.
Address plain(Address address) {
  if (address.is_v6() && address.to_v6().is_v4_mapped()) {
    return boost::asio::ip::make_address_v4(boost::asio::ip::v4_mapped, address.to_v6());
  }
  if (address.is_v6()) {
    auto without_scope = address.to_v6();
    without_scope.scope_id(0);
    return without_scope;
  }
  return address;
}

/// A Host header without its port, and an IPv6 address without its brackets.
std::string_view without_port(std::string_view host) {
  if (host.starts_with('[')) {
    const std::size_t end = host.find(']');
    return end == std::string_view::npos ? std::string_view() : host.substr(1, end - 1);
  }
  return host.substr(0, host.find(':'));
}

bool same_name(std::string_view a, std::string_view b) {
  const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; };
  return std::ranges::equal(a, b, {}, lower, lower);
}

/// In a time that tells nothing of where they differ.
bool same_secret(std::string_view a, std::string_view b) {
  unsigned difference = a.size() == b.size() ? 0 : 1;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    difference |= static_cast<unsigned>(a[i]) ^ static_cast<unsigned>(b[i]);
  }
  return difference == 0;
}

/// Without parameters such as a character set.
std::string_view media_type(std::string_view content_type) {
  const std::string_view type = content_type.substr(0, content_type.find(';'));
  return type.substr(0, type.find_last_not_of(' ') + 1);
}

}  // namespace

std::optional<WebRefusal> WebGuard::refusal(const WebRequest& request,
                                            const Address& address) const {
  constexpr unsigned kForbidden = 403;
  if (!is_ours(request.host, address)) {
    return WebRefusal{kForbidden,
                      "The header Host names another server; open the page by the address that "
                      "penduline has printed."};
  }
  if (request.origin && !same_name(*request.origin, fmt::format("http://{}", request.host))) {
    return WebRefusal{kForbidden, "The header Origin is that of another site's page."};
  }
  return request.is_action ? action_refusal(request) : std::nullopt;
}

std::optional<WebRefusal> WebGuard::action_refusal(const WebRequest& request) const {
  constexpr unsigned kForbidden = 403;
  constexpr unsigned kUnsupportedMediaType = 415;
  if (request.marker != "1") {
    return WebRefusal{kForbidden, "The header X-Penduline: 1 is missing."};
  }
  if (!token_.empty() && !same_secret(request.token, token_)) {
    return WebRefusal{kForbidden,
                      "The token is missing or wrong; open the page by the address that penduline "
                      "has printed, with #token=..."};
  }
  if (!same_name(media_type(request.content_type), "application/json")) {
    return WebRefusal{kUnsupportedMediaType, "The Content-Type is not application/json."};
  }
  return std::nullopt;
}

bool WebGuard::is_ours(std::string_view host, const Address& address) const {
  const std::string_view name = without_port(host);
  if (name.empty()) {
    return false;
  }
  boost::system::error_code no_number;
  const Address number = boost::asio::ip::make_address(std::string(name), no_number);
  if (!no_number) {
    return plain(number) == plain(address);
  }
  return (same_name(name, "localhost") && plain(address).is_loopback()) ||
         (!name_.empty() && same_name(name, name_));
}

std::string new_token() {
  constexpr int kWords = 4;
  std::random_device entropy;  // the kernel's
  std::string token;
  for (int i = 0; i < kWords; ++i) {
    token += fmt::format("{:08x}", entropy());
  }
  return token;
}

}  // namespace penduline
