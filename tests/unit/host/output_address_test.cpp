// SPDX-License-Identifier: Apache-2.0
// Tests of the addresses behind --output.
#include "host/output/output_address.hpp"

#include <catch2/catch.hpp>
#include <string>

namespace {

using namespace penduline;

template <class Address>
Address parsed(const std::string& text) {
  CAPTURE(text);
  const auto address = parse_output(text);
  REQUIRE(address);
  REQUIRE(std::holds_alternative<Address>(*address));
  return std::get<Address>(*address);
}

std::string refused(const std::string& text) {
  const auto address = parse_output(text);
  return address ? "nothing" : address.error().message;
}

TEST_CASE("What has none of the known prefixes is a path", "[output]") {
  for (const char* path :
       {"-", "angles.csv", "./udp:localhost:1", "mqtt.csv", "udp", "/dev/null"}) {
    CHECK(parsed<TextAddress>(path).path == path);
  }
}

TEST_CASE("A UDP address has a host and a port", "[output]") {
  const auto address = parsed<UdpAddress>("udp:localhost:9870");
  CHECK(address.name == "udp:localhost:9870");
  CHECK(address.host == "localhost");
  CHECK(address.port == 9870);
}

TEST_CASE("An IPv6 address stands in brackets", "[output]") {
  CHECK(parsed<UdpAddress>("udp:[ff02::1%eth0]:65535").host == "ff02::1%eth0");
  CHECK(parsed<MqttAddress>("mqtt://[::1]/rig").host == "::1");
  CHECK(parsed<MqttAddress>("mqtt://[::1]:1884/rig").port == 1884);
}

TEST_CASE("A UDP address without a host or a port from 1 to 65535 is refused", "[output]") {
  for (const std::string text :
       {"udp:", "udp:localhost", "udp::9870", "udp:localhost:", "udp:localhost:0", "udp:h:65536",
        "udp:h:9870x", "udp:h:-1", "udp:::1:9870", "udp:[::1]9870", "udp:[]:1", "udp://h:9870"}) {
    CHECK(refused(text) == "found '" + text + "', expected udp:HOST:PORT");
  }
}

TEST_CASE("An MQTT address has a host and a topic, and the usual port", "[output]") {
  const auto address = parsed<MqttAddress>("mqtt://broker/lab/rig1");
  CHECK(address.name == "mqtt://broker/lab/rig1");
  CHECK(address.host == "broker");
  CHECK(address.port == 1883);
  CHECK(address.topic == "lab/rig1");
  CHECK(address.user.empty());
  CHECK(address.password.empty());
  CHECK_FALSE(address.tls);
}

TEST_CASE("MQTT by TLS has a port of its own", "[output]") {
  const auto address = parsed<MqttAddress>("mqtts://broker/rig");
  CHECK(address.tls);
  CHECK(address.port == 8883);
  CHECK(parsed<MqttAddress>("mqtts://broker:1883/rig").port == 1883);
}

TEST_CASE("User and password stand before the host and not in the name", "[output]") {
  const auto address = parsed<MqttAddress>("mqtt://ann:secret@broker:1884/rig");
  CHECK(address.user == "ann");
  CHECK(address.password == "secret");
  CHECK(address.host == "broker");
  CHECK(address.port == 1884);
  CHECK(address.name == "mqtt://broker:1884/rig");
  CHECK(parsed<MqttAddress>("mqtt://ann@broker/rig").user == "ann");
}

TEST_CASE("%XX stands for a byte", "[output]") {
  const auto address = parsed<MqttAddress>("mqtt://a%3Ab:%40%2f%25@broker/lab%201/rig");
  CHECK(address.user == "a:b");
  CHECK(address.password == "@/%");
  CHECK(address.topic == "lab 1/rig");
}

TEST_CASE("An MQTT address that does not say where to publish is refused", "[output]") {
  for (const char* text :
       {"mqtt:", "mqtt:broker/rig", "mqtt://broker", "mqtt://broker/", "mqtt:///rig",
        "mqtt://broker:0/rig", "mqtt://broker:x/rig", "mqtt://broker/rig/", "mqtt://broker/+/rig",
        "mqtt://broker/rig/#", "mqtt://@broker/rig", "mqtt://:pw@broker/rig", "mqtt://b/%2",
        "mqtt://b/%zz", "mqtt://a%:p@b/rig"}) {
    CAPTURE(std::string(text));
    CHECK(refused(text) ==
          "found no broker and topic behind mqtt:, expected "
          "mqtt://[USER[:PASSWORD]@]HOST[:PORT]/TOPIC without + and #");
  }
}

TEST_CASE("A refused MQTT address is not repeated, for the password's sake", "[output]") {
  CHECK(refused("mqtts://ann:secret@broker").find("secret") == std::string::npos);
}

TEST_CASE("No address is refused", "[output]") {
  CHECK(refused("") == "found no output, expected a path, -, udp:HOST:PORT or mqtt://HOST/TOPIC");
}

}  // namespace
