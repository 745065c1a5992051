// SPDX-License-Identifier: Apache-2.0
// Tests of a board's bytes by libusb: what comes, what comes late, and what ends a transfer.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <memory>
#include <string>

#include "hal/linux/usb_port.hpp"
#include "tests/unit/usb/mocked_bus.hpp"
#include "tests/unit/usb/mocked_usb_board.hpp"

namespace {

using namespace penduline;
using namespace penduline::test;
using std::chrono::milliseconds;

using Moment = MockedUsbBoard::Moment;
using Transfer = MockedUsbBoard::Transfer;

constexpr milliseconds kLong{2000};  // for what comes, however busy the machine is
constexpr milliseconds kShort{5};    // for what does not

/// One board, opened.
struct OpenedBoard {
  MockedBus bus{};
  MockedUsbBoard board{bus};
  std::unique_ptr<BytePort> port =
      UsbPort::open({.vendor = kPendulineVendor, .product = kPendulineProduct}).value();

  /// What one reading gives: the bytes, "nothing yet", "end", or why there is none.
  std::string read(milliseconds patience = kLong) {
    std::array<std::uint8_t, 4096> bytes{};
    const auto got = port->read(bytes, patience);
    if (!got) {
      return got.error().message;
    }
    switch (got->outcome) {
      case BytePort::Outcome::kBytes:
        return {bytes.data(), bytes.data() + got->bytes};
      case BytePort::Outcome::kNothingYet:
        return "nothing yet";
      default:
        return "end";
    }
  }

  /// Why the text cannot be written; "" where it can.
  std::string write(const std::string& text) {
    const auto written =
        port->write(std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
    return written ? "" : written.error().message;
  }
};

TEST_CASE("Bytes come in order, and only those that came", "[usb_port]") {
  OpenedBoard opened;
  opened.board.send("first");
  opened.board.send("second");
  CHECK(opened.read() == "first");
  CHECK(opened.read() == "second");
  CHECK(opened.read(kShort) == "nothing yet");
}

TEST_CASE("A reading gives as much as it has room for, the next one the rest", "[usb_port]") {
  OpenedBoard opened;
  opened.board.send(std::string(4096, 'a') + std::string(10, 'b'));
  CHECK((opened.read() == std::string(4096, 'a')));  // not printed
  CHECK(opened.read() == std::string(10, 'b'));
}

TEST_CASE("A packet of zero length is no end", "[usb_port]") {
  OpenedBoard opened;
  opened.board.send("");
  opened.board.send("after it");
  CHECK(opened.read() == "nothing yet");
  CHECK(opened.read() == "after it");
}

TEST_CASE("Where nothing comes, a reading lasts as long as its patience", "[usb_port]") {
  OpenedBoard opened;
  const auto began = std::chrono::steady_clock::now();
  CHECK(opened.read(milliseconds(30)) == "nothing yet");
  CHECK(std::chrono::steady_clock::now() - began >= milliseconds(30));
  // Of libusb none would be for ever.
  CHECK(opened.read(milliseconds(0)) == "nothing yet");
}

TEST_CASE("Bytes that come while a reading is given up are not lost", "[usb_port]") {
  OpenedBoard opened;
  const Moment moment = GENERATE(Moment::kWithCancelled, Moment::kBeforeCancelled);
  opened.board.send_at_cancelling("late", moment);
  CHECK(opened.read(kShort) == "late");
  CHECK(opened.read(kShort) == "nothing yet");
}

TEST_CASE("What is written reaches the board whole", "[usb_port]") {
  OpenedBoard opened;
  const std::string rig(5000, 'r');
  CHECK(opened.write("ping").empty());
  CHECK(opened.write(rig).empty());
  CHECK((opened.board.received() == "ping" + rig));  // not printed
}

TEST_CASE("A board that takes no commands is told after a second", "[usb_port]") {
  OpenedBoard opened;
  opened.board.stop_taking();
  CHECK(opened.write("ping") == "usb:1209:0001: the board takes no commands: Operation timed out");
  opened.board.send("still there");
  CHECK(opened.read() == "still there");
}

TEST_CASE("A board that is unplugged ends a reading, whatever the kernel calls it", "[usb_port]") {
  OpenedBoard opened;
  constexpr const char* kGone =
      "usb:1209:0001: gone: No such device (it may have been disconnected)";
  SECTION("before it") {
    opened.board.unplug();
    CHECK(opened.read() == kGone);
  }
  SECTION("while it waits: shut down") {
    opened.board.unplug_during(Transfer::kRead, -ESHUTDOWN);
    CHECK(opened.read() == kGone);
  }
  SECTION("while it waits: no device") {
    opened.board.unplug_during(Transfer::kRead, -ENODEV);
    CHECK(opened.read() == kGone);
  }
  SECTION("while it waits: the wire is dead before the hub says so") {
    opened.board.unplug_during(Transfer::kRead, -EPROTO);
    CHECK(opened.read() == "usb:1209:0001: gone: Input/Output Error");
  }
  CHECK(opened.read() == kGone);
}

TEST_CASE("Bytes that came before the board was unplugged are not lost", "[usb_port]") {
  OpenedBoard opened;
  const int status = GENERATE(-ESHUTDOWN, -ENODEV, -EPROTO);
  opened.board.unplug_during(Transfer::kRead, status, "the last");
  CHECK(opened.read() == "the last");
  CHECK(opened.read() == "usb:1209:0001: gone: No such device (it may have been disconnected)");
}

TEST_CASE("A board that is unplugged ends a writing", "[usb_port]") {
  OpenedBoard opened;
  constexpr const char* kGone =
      "usb:1209:0001: the board takes no commands: No such device (it may have been disconnected)";
  SECTION("before it") {
    opened.board.unplug();
    CHECK(opened.write("ping") == kGone);
  }
  SECTION("while it waits: shut down") {
    opened.board.unplug_during(Transfer::kWrite, -ESHUTDOWN);
    CHECK(opened.write("ping") == kGone);
  }
  SECTION("while it waits: no device") {
    opened.board.unplug_during(Transfer::kWrite, -ENODEV);
    CHECK(opened.write("ping") == kGone);
  }
  SECTION("while it waits: the wire is dead before the hub says so") {
    opened.board.unplug_during(Transfer::kWrite, -EPROTO);
    CHECK(opened.write("ping") == "usb:1209:0001: the board takes no commands: Input/Output Error");
  }
  CHECK(opened.board.received().empty());
}

}  // namespace
