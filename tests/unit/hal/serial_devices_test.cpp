// SPDX-License-Identifier: Apache-2.0
// Tests of choosing the one board among serial ports.
#include "hal/linux/serial_devices.hpp"

#include <catch2/catch.hpp>
#include <string>
#include <vector>

namespace {

using namespace penduline;

const SerialDevice kPico{.path = "/dev/ttyACM0",
                         .identity = {.vendor = 0x1209, .product = 1, .serial_number = "E660"},
                         .product = "Penduline"};
const SerialDevice kOther{.path = "/dev/ttyACM1",
                          .identity = {.vendor = 0x1209, .product = 1, .serial_number = "E661"},
                          .product = "Penduline"};
const SerialDevice kNucleo{
    .path = "/dev/ttyACM2",
    .identity = {.vendor = 0x0483, .product = 0x374b, .serial_number = "066"},
    .product = "STM32 STLink"};
const SerialDevice kModem{
    .path = "/dev/ttyUSB0", .identity = {.vendor = 0x0403, .product = 0x6001}, .product = ""};

TEST_CASE("The one board is chosen, before any ST-Link", "[serial_devices]") {
  CHECK(choose_board({kModem, kNucleo, kPico}, "").path == "/dev/ttyACM0");
  CHECK(choose_board({kModem, kNucleo}, "").path == "/dev/ttyACM2");
}

TEST_CASE("Of several boards the one with the number is chosen", "[serial_devices]") {
  CHECK(choose_board({kPico, kOther}, "E661").path == "/dev/ttyACM1");
  CHECK(choose_board({kPico, kOther}, "").reason ==
        "found 2 boards, expected one: say which by auto:SERIAL or serial:PATH: /dev/ttyACM0 "
        "(1209:0001 Penduline E660), /dev/ttyACM1 (1209:0001 Penduline E661)");
}

TEST_CASE("Where there is no board, what was looked for and seen is told", "[serial_devices]") {
  CHECK(choose_board({kModem}, "").reason ==
        "found no board: looked for a serial port of the USB device 1209:0001, or of an ST-Link; "
        "USB serial ports seen: /dev/ttyUSB0 (0403:6001)");
  CHECK(choose_board({kPico}, "E66F").reason ==
        "found no board: looked for a serial port of the USB device 1209:0001 numbered E66F, or of "
        "an ST-Link; USB serial ports seen: /dev/ttyACM0 (1209:0001 Penduline E660)");
  CHECK(choose_board({}, "").reason.ends_with("USB serial ports seen: none"));
}

}  // namespace
