// SPDX-License-Identifier: Apache-2.0
// Tests of finding serial ports by udev, and of the program's list of boards.
#include "hal/linux/serial_devices.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdio>
#include <functional>
#include <iterator>
#include <string>
#include <vector>

#include "host/cli/commands.hpp"
#include "host/source/port_finder.hpp"
#include "tests/unit/host/scripted_board.hpp"
#include "tests/unit/temporary_folder.hpp"
#include "tests/unit/usb/mocked_bus.hpp"

namespace {

using namespace penduline;
using namespace penduline::test;

using Lines = std::vector<std::string>;

const PluggedDevice kPico;
const PluggedDevice kNucleo{
    .port = "1-2",
    .identity = {.vendor = 0x0483, .product = 0x374b, .serial_number = "066BFF515750"},
    .product = "STM32 STLink",
    .address = 3};
const PluggedDevice kAdapter{.port = "1-3",
                             .identity = {.vendor = 0x0403, .product = 0x6001},
                             .product = "FT232R USB UART",
                             .address = 4};

/// Plugs a device in of which the kernel makes a serial port.
void plug_in(MockedBus& bus, const PluggedDevice& device, const std::string& port) {
  bus.plug_in(device);
  bus.add_serial_port(device, port);
}

Lines texts_of(const std::vector<SerialDevice>& devices) {
  Lines texts;
  std::ranges::transform(devices, std::back_inserter(texts), &SerialDevice::text);
  return texts;
}

/// Everything that is printed meanwhile.
std::string printed_by(const std::function<void()>& action) {
  const int file = ::memfd_create("printed", 0);
  const int before = ::dup(STDOUT_FILENO);
  std::fflush(stdout);
  REQUIRE(::dup2(file, STDOUT_FILENO) == STDOUT_FILENO);
  action();
  std::fflush(stdout);
  REQUIRE(::dup2(before, STDOUT_FILENO) == STDOUT_FILENO);
  const std::string text = text_of("/proc/self/fd/" + std::to_string(file));
  ::close(before);
  ::close(file);
  return text;
}

/// What `penduline devices` prints, and how it ends.
struct Listing {
  ExitStatus status = ExitStatus::kUsage;
  std::string text = printed_by([this] {
    CLI::App program;
    add_devices_command(program, status);
    program.parse("devices");
  });
};

/// The board's end of a port says the bytes at once; the host finds them when it opens the port.
void say(const MockedBus& bus, const std::string& port, const std::string& bytes) {
  REQUIRE(::write(bus.board_end(port), bytes.data(), bytes.size()) ==
          static_cast<ssize_t>(bytes.size()));
}

TEST_CASE("The serial ports of USB devices are listed in order, others are not",
          "[serial_devices]") {
  MockedBus bus;
  CHECK(serial_devices().empty());
  plug_in(bus, kAdapter, "ttyUSB0");
  plug_in(bus, kPico, "ttyACM1");
  plug_in(bus, kNucleo, "ttyACM0");
  bus.add_platform_port("ttyS0");
  const std::vector<SerialDevice> devices = serial_devices();
  REQUIRE(texts_of(devices) == Lines{"/dev/ttyACM0 (0483:374b STM32 STLink 066BFF515750)",
                                     "/dev/ttyACM1 (1209:0001 Penduline E6605838831B2C21)",
                                     "/dev/ttyUSB0 (0403:6001 FT232R USB UART)"});
  CHECK(devices[0].is_st_link());
  CHECK(devices[1].is_penduline());
  CHECK(choose_board(devices, "").path == "/dev/ttyACM1");
  CHECK(choose_board(devices, "066BFF515750").path == "/dev/ttyACM0");
}

TEST_CASE("A port that is unplugged is no longer listed", "[serial_devices]") {
  MockedBus bus;
  plug_in(bus, kPico, "ttyACM0");
  plug_in(bus, kNucleo, "ttyACM1");
  bus.unplug(kPico);
  CHECK(texts_of(serial_devices()) == Lines{"/dev/ttyACM1 (0483:374b STM32 STLink 066BFF515750)"});
}

TEST_CASE("A device that says nothing of itself is listed by its numbers", "[serial_devices]") {
  MockedBus bus;
  PluggedDevice silent;
  silent.product = "";
  silent.identity.serial_number = "";
  plug_in(bus, silent, "ttyACM0");
  CHECK(texts_of(serial_devices()) == Lines{"/dev/ttyACM0 (1209:0001)"});
}

TEST_CASE("A device whose numbers are none is not listed", "[serial_devices]") {
  MockedBus bus;
  plug_in(bus, kPico, "ttyACM0");
  bus.set_attribute(kPico, "idVendor", GENERATE("", "penduline", "12090", "-1", "0x1209"));
  CHECK(serial_devices().empty());
}

TEST_CASE("What a device says of itself cannot command the terminal", "[serial_devices]") {
  MockedBus bus;
  plug_in(bus, kPico, "ttyACM0");
  bus.set_attribute(kPico, "product", "a\x1b[2Jb\nc");
  bus.set_attribute(kPico, "serial", "E6\r60");
  CHECK(texts_of(serial_devices()) == Lines{"/dev/ttyACM0 (1209:0001 a?[2Jb?c E6?60)"});
}

TEST_CASE("Where there is no board, auto tells what it saw", "[serial_devices]") {
  MockedBus bus;
  plug_in(bus, kAdapter, "ttyUSB0");
  const auto port = port_opener(*parse_uri("auto"))(false);
  REQUIRE(!port);
  CHECK(port.error().message ==
        "found no board: looked for a serial port of the USB device 1209:0001, or of an ST-Link; "
        "USB serial ports seen: /dev/ttyUSB0 (0403:6001 FT232R USB UART)");
}

TEST_CASE("The board that auto opened last is found again under another name", "[serial_devices]") {
  MockedBus bus;
  plug_in(bus, kPico, "ttyACM0");
  bus.make_file_of("ttyACM0");
  PortOpener open = port_opener(*parse_uri("auto"));
  CHECK(open(false).value()->name() == "/dev/ttyACM0");
  bus.unplug(kPico);
  PluggedDevice other = kNucleo;
  other.identity = {
      .vendor = kPendulineVendor, .product = kPendulineProduct, .serial_number = "E1"};
  plug_in(bus, other, "ttyACM1");
  bus.make_file_of("ttyACM1");
  const auto absent = open(true);
  REQUIRE(!absent);
  CHECK(absent.error().message ==
        "found no serial port of the USB device 1209:0001:E6605838831B2C21");
  plug_in(bus, kPico, "ttyACM2");
  bus.make_file_of("ttyACM2");
  CHECK(open(true).value()->name() == "/dev/ttyACM2");
}

TEST_CASE("What auto opened and was no board is not stuck to", "[serial_devices]") {
  MockedBus bus;
  plug_in(bus, kNucleo, "ttyACM0");
  bus.make_file_of("ttyACM0");
  PortOpener open = port_opener(*parse_uri("auto"));
  CHECK(open(false).value()->name() == "/dev/ttyACM0");
  plug_in(bus, kPico, "ttyACM1");
  bus.make_file_of("ttyACM1");
  CHECK(open(false).value()->name() == "/dev/ttyACM1");
}

TEST_CASE("The boards are listed with what they say, or why they do not", "[devices]") {
  MockedBus bus;
  plug_in(bus, kPico, "ttyACM0");
  plug_in(bus, kNucleo, "ttyACM1");
  plug_in(bus, kAdapter, "ttyUSB0");
  say(bus, "ttyACM0", frame_of(hello_of_boot(1)));
  MockedBus::forbid("/dev/ttyACM1");
  const WithoutPrivileges user;
  const Listing listing;
  CHECK(listing.status == ExitStatus::kDone);
  CHECK(listing.text ==
        "port          serial number     board  firmware  state\n"
        "/dev/ttyACM0  E6605838831B2C21  pico   1.2.3     samples at 50 Hz, emitters switched\n"
        "/dev/ttyACM1  066BFF515750                       Permission denied\n");
}

TEST_CASE("Where there is no board to list, what was looked for is told", "[devices]") {
  MockedBus bus;
  const Listing listing;
  CHECK(listing.status == ExitStatus::kFailed);
  CHECK(listing.text.ends_with(
      "found no board: looked for a serial port of the USB device 1209:0001, or of an ST-Link; USB "
      "serial ports seen: none\n"));
}

}  // namespace
