// SPDX-License-Identifier: Apache-2.0
// Tests of opening a board by libusb: which one is found, why not, and what the kernel is asked
// for.
#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "hal/linux/usb_port.hpp"
#include "tests/unit/usb/mocked_bus.hpp"
#include "tests/unit/usb/mocked_usb_board.hpp"

namespace {

using namespace penduline;
using namespace penduline::test;

using Lines = std::vector<std::string>;

/// Any board, by its identity's numbers.
const UsbIdentity kAnyBoard{.vendor = kPendulineVendor, .product = kPendulineProduct};

UsbIdentity numbered(const std::string& serial_number) {
  UsbIdentity identity = kAnyBoard;
  identity.serial_number = serial_number;
  return identity;
}

PluggedDevice second_board() {
  return {.port = "1-2", .identity = numbered("E6605838831B2C22"), .address = 3};
}

/// Why it cannot be opened; "" where it can.
std::string refusal(const UsbIdentity& identity) {
  const auto port = UsbPort::open(identity);
  return port ? "" : port.error().message;
}

TEST_CASE("The board is found among other devices by its vendor and product", "[usb_port]") {
  MockedBus bus;
  const MockedUsbBoard other(
      bus, {.port = "1-3", .identity = {.vendor = 0x0403, .product = 0x6001}, .address = 4});
  const MockedUsbBoard board(bus);
  const auto port = UsbPort::open(kAnyBoard);
  REQUIRE(port);
  CHECK((*port)->name() == "usb:1209:0001");
  CHECK((*port)->two_way());
  CHECK(board.owner(1) == "Penduline");
  CHECK(other.requests().empty());
}

TEST_CASE("Of two boards the one with the serial number is opened", "[usb_port]") {
  MockedBus bus;
  const MockedUsbBoard first(bus);
  const MockedUsbBoard second(bus, second_board());
  const auto port = UsbPort::open(numbered("E6605838831B2C22"));
  REQUIRE(port);
  CHECK((*port)->name() == "usb:1209:0001:E6605838831B2C22");
  CHECK(second.owner(1) == "Penduline");
  CHECK(first.owner(1) == "cdc_acm");
}

TEST_CASE("Of two boards none is opened without a serial number", "[usb_port]") {
  MockedBus bus;
  const MockedUsbBoard first(bus);
  const MockedUsbBoard second(bus, second_board());
  CHECK(refusal(kAnyBoard) ==
        "usb:1209:0001: found 2 such devices, expected one: add :SERIAL, one of "
        "E6605838831B2C21, E6605838831B2C22");
  CHECK(first.requests().empty());
  CHECK(second.requests().empty());
}

TEST_CASE("A board that is not there is told", "[usb_port]") {
  MockedBus bus;
  CHECK(refusal(kAnyBoard) == "usb:1209:0001: found no such USB device");
  const MockedUsbBoard board(bus);
  CHECK(refusal(numbered("E66F")) == "usb:1209:0001:E66F: found no such USB device");
}

TEST_CASE("A board without a serial number is found by its numbers alone", "[usb_port]") {
  MockedBus bus;
  const MockedUsbBoard board(bus, {.identity = kAnyBoard});
  CHECK(refusal(kAnyBoard).empty());
  CHECK(refusal(numbered("E66F")) == "usb:1209:0001:E66F: found no such USB device");
}

TEST_CASE("A board that the user may not open is told with what helps", "[usb_port]") {
  MockedBus bus;
  const MockedUsbBoard board(bus);
  MockedBus::forbid(MockedBus::node({}));
  const WithoutPrivileges user;
  CHECK(refusal(kAnyBoard) ==
        "usb:1209:0001: found it, but may not open it: install Penduline's udev rules, or run as "
        "root");
  CHECK(board.requests().empty());
}

TEST_CASE("A board that the user may open is taken beside one that he may not", "[usb_port]") {
  MockedBus bus;
  const MockedUsbBoard first(bus);
  const MockedUsbBoard second(bus, second_board());
  MockedBus::forbid(MockedBus::node({}));
  const WithoutPrivileges user;
  CHECK(refusal(second_board().identity).empty());
}

TEST_CASE("A board that another program has is told and left alone", "[usb_port]") {
  MockedBus bus;
  MockedUsbBoard board(bus);
  SECTION("both interfaces, as a second run of this program finds them") {
    const auto first = UsbPort::open(kAnyBoard);
    REQUIRE(first);
    CHECK(refusal(kAnyBoard) == "usb:1209:0001: another program has the device");
    CHECK(board.owner(0) == "Penduline");
    CHECK(board.owner(1) == "Penduline");
  }
  SECTION("one interface: the other is given back") {
    board.give_to(0, "");
    board.give_to(1, "another program");
    CHECK(refusal(kAnyBoard) == "usb:1209:0001: another program has the device");
    CHECK(board.owner(0).empty());
    CHECK(board.owner(1) == "another program");
  }
}

TEST_CASE("A device with the board's numbers and no serial port is told", "[usb_port]") {
  MockedBus bus;
  PluggedDevice device;
  device.descriptors = descriptors_without_port(device.identity);
  const MockedUsbBoard board(bus, device);
  CHECK(refusal(kAnyBoard) == "usb:1209:0001: found no serial port (CDC-ACM) in the device");
  CHECK(board.requests().empty());
}

TEST_CASE("The kernel's driver lends both interfaces and gets them back", "[usb_port]") {
  MockedBus bus;
  const MockedUsbBoard board(bus);
  {
    const auto port = UsbPort::open(kAnyBoard);
    REQUIRE(port);
    CHECK(board.requests() == Lines{"disconnect 0", "claim 0", "claim 1", "line state 1 of 0"});
  }
  // The control interface last: it is the one that the driver knows, and both must be free.
  const Lines requests = board.requests();
  CHECK(Lines(requests.begin() + 4, requests.end()) ==
        Lines{"release 1", "connect 1", "release 0", "connect 0"});
  CHECK(board.owner(0) == "cdc_acm");
  CHECK(board.owner(1) == "cdc_acm");
}

TEST_CASE("A board that no driver has is opened all the same", "[usb_port]") {
  MockedBus bus;
  MockedUsbBoard board(bus);
  board.give_to(0, "");
  board.give_to(1, "");
  const auto port = UsbPort::open(kAnyBoard);
  REQUIRE(port);
  CHECK(board.requests() == Lines{"claim 0", "claim 1", "line state 1 of 0"});
}

}  // namespace
