// SPDX-License-Identifier: Apache-2.0
// Tests of where the web server is to listen.
#include "host/web/web_address.hpp"

#include <catch2/catch.hpp>
#include <string>

namespace {

using namespace penduline;

std::string read(const char* text) {
  const auto address = parse_web_address(text);
  return address ? address->host + " " + std::to_string(address->port) : "refused";
}

TEST_CASE("A port alone is one of this machine only", "[web]") {
  CHECK(read("8080") == "127.0.0.1 8080");
  CHECK(read("0") == "127.0.0.1 0");
}

TEST_CASE("An address stands before the port, IPv6 in brackets", "[web]") {
  CHECK(read("0.0.0.0:8080") == "0.0.0.0 8080");
  CHECK(read("[::]:8080") == ":: 8080");
  CHECK(read("rig.example:1") == "rig.example 1");
}

TEST_CASE("What is no port is refused, and the message says what is expected", "[web]") {
  for (const char* text : {"", "http", "65536", "-1", ":8080", "127.0.0.1:", "::1:8080", "[]:1"}) {
    INFO(text);
    CHECK(read(text) == "refused");
  }
  CHECK(parse_web_address("65536").error().message ==
        "found '65536', expected [ADDR:]PORT such as 8080, 0.0.0.0:8080 or [::]:8080, PORT being 0 "
        "to 65535 (0: any that is free)");
}

}  // namespace
