// SPDX-License-Identifier: Apache-2.0
// Finding ports by path, by USB identity, or by being the only board there is.
#include "host/source/port_finder.hpp"

#include <filesystem>
#include <optional>

#include "hal/linux/serial_devices.hpp"
#include "hal/linux/serial_port.hpp"
#include "hal/linux/usb_port.hpp"

namespace penduline {
namespace {

using OpenedPort = tl::expected<std::unique_ptr<BytePort>, Error>;

std::optional<SerialDevice> device_at(const std::string& path) {
  std::error_code failed;
  const std::string real = std::filesystem::canonical(path, failed).string();
  for (const SerialDevice& device : serial_devices()) {
    if (device.path == real) {
      return device;
    }
  }
  return std::nullopt;
}

/// Serial ports, by path or the only board.
class SerialPortFinder {
 public:
  explicit SerialPortFinder(SourceUri uri) : uri_(std::move(uri)) {}

  OpenedPort operator()() {
    const auto path = find();
    if (!path) {
      return tl::unexpected(path.error());
    }
    auto port = SerialPort::open(*path, uri_.baud);
    if (port && !opened_) {
      if (const auto device = device_at(*path); device && !device->identity.serial_number.empty()) {
        opened_ = device->identity;
      }
    }
    return port;
  }

 private:
  tl::expected<std::string, Error> find() const {
    if (opened_) {
      for (const SerialDevice& device : serial_devices()) {
        if (device.identity == *opened_) {
          return device.path;
        }
      }
      return failure("found no serial port of the USB device " + opened_->text());
    }
    if (uri_.kind == SourceUri::Kind::kSerial) {
      return uri_.path;
    }
    const AutoChoice choice = choose_board(serial_devices(), uri_.serial_number);
    return choice.path.empty() ? tl::expected<std::string, Error>(failure(choice.reason))
                               : choice.path;
  }

  SourceUri uri_;
  std::optional<UsbIdentity> opened_;  ///< of the device that was opened first
};

}  // namespace

PortOpener port_opener(const SourceUri& uri) {
  if (uri.kind == SourceUri::Kind::kUsb) {
    return [identity = uri.usb] { return UsbPort::open(identity); };
  }
  return SerialPortFinder(uri);
}

}  // namespace penduline
