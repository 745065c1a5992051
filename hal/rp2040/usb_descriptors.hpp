// SPDX-License-Identifier: Apache-2.0
// What the board tells a USB host of itself: one serial port (USB 2.0 ch. 9; CDC 1.2, PSTN 1.2).
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace penduline::rp2040::usb {

inline constexpr std::uint8_t kNotifyEndpoint =
    1;                                            ///< in, interrupt; never used, but must be there
inline constexpr std::uint8_t kDataEndpoint = 2;  ///< in and out, bulk
inline constexpr std::uint8_t kPacketBytes = 64;
inline constexpr std::uint16_t kDataInterface = 1;

inline constexpr std::array<std::uint8_t, 18> kDeviceDescriptor = {
    18,
    1,  // length, device
    0x00,
    0x02,  // USB 2.0
    2,
    0,
    0,             // class: communications
    kPacketBytes,  // of endpoint 0
    0x09,
    0x12,  // vendor 1209, pid.codes
    0x01,
    0x00,  // product 0001, its test id
    0x00,
    0x01,  // release 1.00
    1,
    2,
    3,  // strings: maker, product, serial number
    1,  // configurations
};

inline constexpr std::array<std::uint8_t, 67> kConfigurationDescriptor = {
    9,
    2,
    67,
    0,
    2,
    1,
    0,
    0x80,
    50,  // two interfaces, bus powered, 100 mA
    9,
    4,
    0,
    0,
    1,
    2,
    2,
    0,
    0,  // interface 0: control model "serial port"
    5,
    0x24,
    0,
    0x10,
    0x01,  // CDC 1.10
    5,
    0x24,
    1,
    0,
    1,  // calls are not handled
    4,
    0x24,
    2,
    2,  // line coding and line state are
    5,
    0x24,
    6,
    0,
    1,  // interface 0 controls interface 1
    7,
    5,
    0x80 | kNotifyEndpoint,
    3,
    8,
    0,
    16,  // interrupt in, 8 bytes, every 16 ms
    9,
    4,
    1,
    0,
    2,
    10,
    0,
    0,
    0,  // interface 1: data
    7,
    5,
    kDataEndpoint,
    2,
    kPacketBytes,
    0,
    0,  // bulk out
    7,
    5,
    0x80 | kDataEndpoint,
    2,
    kPacketBytes,
    0,
    0,  // bulk in
};

inline constexpr std::string_view kMaker = "Penduline";
inline constexpr std::string_view kProduct = "Penduline";

}  // namespace penduline::rp2040::usb
