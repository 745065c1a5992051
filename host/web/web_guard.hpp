// SPDX-License-Identifier: Apache-2.0
// Who may ask the web server for what: a page of another site may not, whatever its name means.
#pragma once

#include <boost/asio/ip/address.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace penduline {

/// What of a request decides whether it is heeded. Views into the request.
struct WebRequest {
  bool is_action = false;  ///< POST; else GET
  std::string_view host;   ///< header Host; "" where there is none or more than one
  std::optional<std::string_view> origin{};
  std::string_view content_type{};
  std::string_view marker{};  ///< header X-Penduline
  std::string_view token{};   ///< header X-Penduline-Token
};

/// Why a request is not heeded: a status of HTTP and one sentence for a person.
struct WebRefusal {
  unsigned status = 0;
  std::string sentence;
};

/// The rules of one server.
class WebGuard {
 public:
  /// `name` is what was typed for the address to listen on, "" for none. `token` is what actions
  /// need; "" on loopback, where they need none.
  WebGuard(std::string name, std::string token)
      : name_(std::move(name)), token_(std::move(token)) {}

  /// Why the request that came to the server's `address` is refused; none where it is heeded.
  [[nodiscard]] std::optional<WebRefusal> refusal(const WebRequest& request,
                                                  const boost::asio::ip::address& address) const;

  [[nodiscard]] const std::string& token() const { return token_; }

 private:
  /// A site that has its name point to this server's address (DNS rebinding) still sends that name.
  [[nodiscard]] bool is_ours(std::string_view host, const boost::asio::ip::address& address) const;
  [[nodiscard]] std::optional<WebRefusal> action_refusal(const WebRequest& request) const;

  std::string name_;
  std::string token_;
};

/// 128 bits that nobody can guess, in hexadecimal.
[[nodiscard]] std::string new_token();

}  // namespace penduline
