// SPDX-License-Identifier: Apache-2.0
// Tests of who may ask the web server for what.
#include "host/web/web_guard.hpp"

#include <catch2/catch.hpp>
#include <set>
#include <string>

namespace {

using namespace penduline;

const auto kLoopback = boost::asio::ip::make_address("127.0.0.1");
const auto kNetwork = boost::asio::ip::make_address("192.0.2.7");

unsigned status_of(const WebGuard& guard, const WebRequest& request,
                   const boost::asio::ip::address& address) {
  const auto refused = guard.refusal(request, address);
  return refused ? refused->status : 0;
}

unsigned viewing(std::string_view host, const boost::asio::ip::address& address = kLoopback,
                 const std::string& name = "127.0.0.1") {
  return status_of(WebGuard(name, ""), {.host = host}, address);
}

WebRequest action() {
  return {.is_action = true,
          .host = "127.0.0.1:8080",
          .origin = "http://127.0.0.1:8080",
          .content_type = "application/json",
          .marker = "1"};
}

TEST_CASE("Hosts that are this server's are heeded", "[web]") {
  CHECK(viewing("127.0.0.1:8080") == 0);
  CHECK(viewing("127.0.0.1") == 0);
  CHECK(viewing("localhost:8080") == 0);
  CHECK(viewing("LocalHost") == 0);
  CHECK(viewing("192.0.2.7:8080", kNetwork, "0.0.0.0") == 0);
  CHECK(viewing("rig.example:8080", kNetwork, "rig.example") == 0);
  const auto v6 = boost::asio::ip::make_address("::1");
  CHECK(viewing("[::1]:8080", v6, "::1") == 0);
  CHECK(viewing("localhost:8080", v6, "::1") == 0);
  CHECK(viewing("192.0.2.7", boost::asio::ip::make_address("::ffff:192.0.2.7"), "::") == 0);
}

TEST_CASE("Hosts that may be another site's name for this address are refused", "[web]") {
  for (const char* host : {"", "evil.example:8080", "evil.example", "192.0.2.8", "127.0.0.1.evil",
                           "localhost.evil", "[::1", ":8080", "127.0.0.2"}) {
    INFO(host);
    CHECK(viewing(host) == 403);
  }
  CHECK(viewing("localhost", kNetwork, "0.0.0.0") == 403);
  CHECK(viewing("127.0.0.1", kNetwork, "0.0.0.0") == 403);
}

TEST_CASE("A page of another origin is refused, also to look", "[web]") {
  const WebGuard guard("127.0.0.1", "");
  const auto from = [&](std::string_view origin) {
    return status_of(guard, {.host = "127.0.0.1:8080", .origin = origin}, kLoopback);
  };
  CHECK(from("http://127.0.0.1:8080") == 0);
  CHECK(from("http://evil.example") == 403);
  CHECK(from("http://127.0.0.1:9090") == 403);
  CHECK(from("https://127.0.0.1:8080") == 403);
  CHECK(from("null") == 403);
  CHECK(from("") == 403);
}

TEST_CASE("An action on loopback needs the header, JSON and nothing more", "[web]") {
  const WebGuard guard("127.0.0.1", "");
  WebRequest request = action();
  CHECK(status_of(guard, request, kLoopback) == 0);
  request.origin.reset();
  CHECK(status_of(guard, request, kLoopback) == 0);
  request.content_type = "application/json; charset=utf-8";
  CHECK(status_of(guard, request, kLoopback) == 0);
  request.content_type = "text/plain";
  CHECK(status_of(guard, request, kLoopback) == 415);
  request = action();
  request.marker = "";
  CHECK(status_of(guard, request, kLoopback) == 403);
}

TEST_CASE("An action beyond loopback needs the token, watching does not", "[web]") {
  const WebGuard guard("0.0.0.0", "0123456789abcdef");
  WebRequest request = action();
  request.host = "192.0.2.7:8080";
  request.origin = "http://192.0.2.7:8080";
  for (const char* wrong : {"", "0123456789abcdee", "0123456789abcde", "0123456789abcdef0"}) {
    INFO(wrong);
    request.token = wrong;
    CHECK(status_of(guard, request, kNetwork) == 403);
  }
  request.token = "0123456789abcdef";
  CHECK(status_of(guard, request, kNetwork) == 0);
  CHECK(status_of(guard, {.host = "192.0.2.7:8080"}, kNetwork) == 0);
}

TEST_CASE("Tokens have 128 bits and are never the same", "[web]") {
  std::set<std::string> tokens;
  for (int i = 0; i < 100; ++i) {
    tokens.insert(new_token());
  }
  CHECK(tokens.size() == 100);
  CHECK(tokens.begin()->size() == 32);
  CHECK(tokens.begin()->find_first_not_of("0123456789abcdef") == std::string::npos);
}

}  // namespace
