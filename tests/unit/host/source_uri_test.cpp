// SPDX-License-Identifier: Apache-2.0
// Tests of what a source's URI says.
#include "host/source/source_uri.hpp"

#include <catch2/catch.hpp>
#include <string>

namespace {

using namespace penduline;
using Kind = SourceUri::Kind;

TEST_CASE("Each form of a URI says its kind and what belongs to it", "[uri]") {
  CHECK(parse_uri("sim:")->kind == Kind::kSimulation);
  CHECK(parse_uri("file:a?b.csv")->path == "a?b.csv");
  CHECK(parse_uri("serial:/dev/ttyACM0")->path == "/dev/ttyACM0");
  CHECK(parse_uri("serial:/dev/ttyACM0")->baud == 460'800);
  CHECK(parse_uri("serial:/dev/ttyUSB0?baud=115200")->baud == 115'200);
  CHECK(parse_uri("serial:/dev/ttyUSB0?baud=115200")->path == "/dev/ttyUSB0");
  CHECK(parse_uri("auto")->kind == Kind::kAuto);
  CHECK(parse_uri("auto:E660")->serial_number == "E660");
  CHECK(parse_uri("usb:1209:0001")->usb == UsbIdentity{.vendor = 0x1209, .product = 1});
  CHECK(parse_uri("usb:1209:1:E660")->usb.serial_number == "E660");
}

TEST_CASE("What is no URI is told with the forms that there are", "[uri]") {
  for (const char* text : {"", "sim", "file:", "serial:", "auto:", "/dev/ttyACM0"}) {
    CHECK(parse_uri(text).error().message ==
          "found '" + std::string(text) +
              "', expected auto, serial:PATH, usb:VID:PID, file:PATH or sim:");
  }
  CHECK(parse_uri("serial:x?baud=fast").error().message ==
        "found '?baud=fast', expected ?baud= and a number");
  for (const char* text : {"usb:", "usb:1209", "usb:1209:zz", "usb:1209:0001:", "usb:12345:1"}) {
    CHECK(parse_uri(text).error().message.ends_with("as in usb:1209:0001"));
  }
}

}  // namespace
