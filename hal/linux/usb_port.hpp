// SPDX-License-Identifier: Apache-2.0
// A board's USB serial port (CDC-ACM) by libusb, without the kernel's driver.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <tl/expected.hpp>

#include "hal/linux/byte_port.hpp"
#include "hal/linux/usb_identity.hpp"

struct libusb_context;
struct libusb_device_handle;

namespace penduline {

class UsbPort final : public BytePort {
 public:
  /// Opens the one device of this identity and takes its interfaces from the kernel's driver, which
  /// gets them back in the end. Fails where there is none, more than one, or one that may not be
  /// opened, saying what to do.
  static tl::expected<std::unique_ptr<UsbPort>, Error> open(const UsbIdentity& identity);

  UsbPort(const UsbPort&) = delete;
  UsbPort& operator=(const UsbPort&) = delete;
  ~UsbPort() override;

  tl::expected<Got, Error> read(std::span<std::uint8_t> bytes,
                                std::chrono::milliseconds patience) override;
  tl::expected<void, Error> write(std::span<const std::uint8_t> bytes) override;
  [[nodiscard]] bool two_way() const override { return true; }
  [[nodiscard]] const std::string& name() const override { return name_; }
  /// The device's own, its serial number included.
  [[nodiscard]] const UsbIdentity& identity() const { return identity_; }

 private:
  UsbPort() = default;
  tl::expected<void, Error> find(const UsbIdentity& identity);
  tl::expected<void, Error> claim();
  [[nodiscard]] Error error(const char* what, int code) const;

  std::string name_;
  UsbIdentity identity_;
  libusb_context* context_ = nullptr;
  libusb_device_handle* device_ = nullptr;
  int control_interface_ = -1;
  int data_interface_ = -1;
  bool control_claimed_ = false;
  bool data_claimed_ = false;
  std::uint8_t in_endpoint_ = 0;
  std::uint8_t out_endpoint_ = 0;
};

}  // namespace penduline
