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

  OpenedPort operator()(bool same_device) {
    const auto path = find(same_device);
    if (!path) {
      return tl::unexpected(path.error());
    }
    auto port = SerialPort::open(*path, uri_.baud);
    if (port) {
      const auto device = device_at(*path);
      opened_ = device && !device->identity.serial_number.empty() ? std::optional(device->identity)
                                                                  : std::nullopt;
    }
    return port;
  }

 private:
  tl::expected<std::string, Error> find(bool same_device) const {
    if (same_device && opened_) {
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
  std::optional<UsbIdentity> opened_;  ///< of the device that was opened last
};

}  // namespace

PortOpener port_opener(const SourceUri& uri) {
  if (uri.kind == SourceUri::Kind::kUsb) {
    return [asked = uri.usb, opened = uri.usb](bool same_device) mutable -> OpenedPort {
      auto port = UsbPort::open(same_device ? opened : asked);
      if (!port) {
        return tl::unexpected(port.error());
      }
      opened = (*port)->identity();
      return std::move(*port);
    };
  }
  return SerialPortFinder(uri);
}

}  // namespace penduline
