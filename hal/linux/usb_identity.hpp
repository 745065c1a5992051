// SPDX-License-Identifier: Apache-2.0
// By what a device is known on USB.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace penduline {

struct UsbIdentity {
  std::uint16_t vendor = 0;
  std::uint16_t product = 0;
  std::string serial_number{};  ///< "": any

  /// "1209:0001", with ":SERIAL" where one is known.
  [[nodiscard]] std::string text() const;
  friend bool operator==(const UsbIdentity&, const UsbIdentity&) = default;
};

/// A board with its own USB, flashed with our firmware (pid.codes' test id until one is assigned).
inline constexpr std::uint16_t kPendulineVendor = 0x1209;
inline constexpr std::uint16_t kPendulineProduct = 0x0001;

/// Reads "VID:PID[:SERIAL]", the numbers in hexadecimal; none where it is nothing of the kind.
[[nodiscard]] std::optional<UsbIdentity> parse_usb_identity(std::string_view text);

}  // namespace penduline
