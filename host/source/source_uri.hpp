// SPDX-License-Identifier: Apache-2.0
// What a source's URI says.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <tl/expected.hpp>

#include "hal/error.hpp"
#include "hal/linux/serial_port.hpp"
#include "hal/linux/usb_identity.hpp"

namespace penduline {

/// `sim:`, `file:PATH`, `serial:PATH[?baud=N]`, `usb:VID:PID[:SERIAL]` or `auto[:SERIAL]`.
struct SourceUri {
  enum class Kind { kSimulation, kRecording, kSerial, kUsb, kAuto };
  Kind kind = Kind::kSimulation;
  std::string path{};  ///< of kRecording and kSerial
  std::uint32_t baud = SerialPort::kDefaultBaud;
  UsbIdentity usb{};            ///< of kUsb
  std::string serial_number{};  ///< of kAuto; "": any

  /// Whether samples come from a board, or from something that stands in for one.
  [[nodiscard]] bool is_board() const {
    return kind == Kind::kSerial || kind == Kind::kUsb || kind == Kind::kAuto;
  }
};

/// Every form that there is, for messages and help.
inline constexpr std::string_view kSourceForms =
    "auto, serial:PATH, usb:VID:PID, file:PATH or sim:";

/// Reads a URI; fails saying what was found and expected.
[[nodiscard]] tl::expected<SourceUri, Error> parse_uri(std::string_view text);

}  // namespace penduline
