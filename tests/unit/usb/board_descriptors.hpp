// SPDX-License-Identifier: Apache-2.0
// What a board says of itself on USB: the Pico's own descriptors, as a test wants them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "hal/linux/usb_identity.hpp"
#include "hal/rp2040/usb_descriptors.hpp"

namespace penduline::test {

/// The index of the serial number among the strings.
inline constexpr std::uint8_t kSerialNumberString = 3;

template <class Bytes>
std::string text_of_bytes(const Bytes& bytes) {
  return {bytes.begin(), bytes.end()};
}

/// The Pico's device and configuration descriptors, with the numbers of this identity.
inline std::string pico_descriptors(const UsbIdentity& identity) {
  constexpr std::size_t kVendorAt = 8;
  constexpr std::size_t kProductAt = 10;
  constexpr std::size_t kSerialNumberAt = 16;
  std::string device = text_of_bytes(rp2040::usb::kDeviceDescriptor);
  const auto put = [&](std::size_t at, std::uint16_t number) {
    device[at] = static_cast<char>(number & 0xff);
    device[at + 1] = static_cast<char>(number >> 8);
  };
  put(kVendorAt, identity.vendor);
  put(kProductAt, identity.product);
  device[kSerialNumberAt] = identity.serial_number.empty() ? 0 : kSerialNumberString;
  return device + text_of_bytes(rp2040::usb::kConfigurationDescriptor);
}

/// The same for a device whose two interfaces are no serial port, but of the vendor's own class.
inline std::string descriptors_without_port(const UsbIdentity& identity) {
  constexpr std::size_t kFirstClassAt = 18 + 9 + 5;
  constexpr std::size_t kSecondClassAt = 18 + 51 - 7 - 7 - 9 + 5;
  constexpr char kVendorsOwn = '\xff';
  std::string bytes = pico_descriptors(identity);
  bytes[kFirstClassAt] = kVendorsOwn;
  bytes[kSecondClassAt] = kVendorsOwn;
  return bytes;
}

/// A string descriptor: characters of 16 bits behind length and type.
inline std::string string_descriptor(const std::string& text) {
  constexpr char kStringType = 3;
  std::string bytes = {static_cast<char>(2 + 2 * text.size()), kStringType};
  for (const char character : text) {
    bytes += {character, '\0'};
  }
  return bytes;
}

/// The list of languages, which stands before the strings: English.
inline const std::string kLanguages = {4, 3, 0x09, 0x04};

}  // namespace penduline::test
