// SPDX-License-Identifier: Apache-2.0
// The serial ports that the kernel has made of USB devices.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "hal/linux/usb_identity.hpp"

namespace penduline {

struct SerialDevice {
  std::string path;  ///< "/dev/ttyACM0"
  UsbIdentity identity;
  std::string product;  ///< as the device names itself; may be empty

  /// A board with Penduline's USB identity.
  [[nodiscard]] bool is_penduline() const {
    return identity.vendor == kPendulineVendor && identity.product == kPendulineProduct;
  }
  /// The port of an ST-Link, behind which a Nucleo may be.
  [[nodiscard]] bool is_st_link() const;
  /// "/dev/ttyACM0 (1209:0001 Penduline E66038B713952D31)".
  [[nodiscard]] std::string text() const;
};

/// The serial ports of USB devices (ttyACM and ttyUSB), by udev, in the order of their paths.
[[nodiscard]] std::vector<SerialDevice> serial_devices();

/// What `auto` came to: a path, or in words why there is none.
struct AutoChoice {
  std::string path{};
  std::string reason{};
};

/// The one board among the devices. A serial number, where it is not empty, must be the board's. An
/// ST-Link is taken where there is no board with USB of its own.
[[nodiscard]] AutoChoice choose_board(const std::vector<SerialDevice>& devices,
                                      std::string_view serial_number);

}  // namespace penduline
