// SPDX-License-Identifier: Apache-2.0
// Finding, claiming and giving back a device; bulk transfers (CDC 1.2, PSTN 1.2).
#include "hal/linux/usb_port.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <libusb.h>

#include <algorithm>
#include <array>
#include <vector>

namespace penduline {
namespace {

using Handle = std::unique_ptr<libusb_device_handle, decltype(&libusb_close)>;

/// The devices on all busses, as long as it lives.
class DeviceList {
 public:
  explicit DeviceList(libusb_context* context) : count_(libusb_get_device_list(context, &list_)) {}
  DeviceList(const DeviceList&) = delete;
  DeviceList& operator=(const DeviceList&) = delete;
  ~DeviceList() {
    if (count_ >= 0) {
      libusb_free_device_list(list_, 1);
    }
  }
  [[nodiscard]] std::span<libusb_device*> devices() const {
    return {list_, static_cast<std::size_t>(std::max<ssize_t>(count_, 0))};
  }

 private:
  libusb_device** list_ = nullptr;
  ssize_t count_;
};

std::string serial_number_of(libusb_device_handle* device, std::uint8_t index) {
  std::array<unsigned char, 256> text{};
  const int length =
      libusb_get_string_descriptor_ascii(device, index, text.data(), static_cast<int>(text.size()));
  return length > 0 ? std::string(text.begin(), text.begin() + length) : std::string();
}

}  // namespace

tl::expected<std::unique_ptr<UsbPort>, Error> UsbPort::open(const UsbIdentity& identity) {
  std::unique_ptr<UsbPort> port(new UsbPort());
  port->name_ = "usb:" + identity.text();
  if (const int code = libusb_init(&port->context_); code != LIBUSB_SUCCESS) {
    port->context_ = nullptr;
    return tl::unexpected(port->error("USB cannot be used", code));
  }
  if (auto found = port->find(identity); !found) {
    return tl::unexpected(found.error());
  }
  if (auto claimed = port->claim(); !claimed) {
    return tl::unexpected(claimed.error());
  }
  return port;
}

/// Opens the device; of those that may not be opened only the identity's numbers are known.
tl::expected<void, Error> UsbPort::find(const UsbIdentity& identity) {
  const DeviceList list(context_);
  std::vector<std::string> serial_numbers;
  int refusal = LIBUSB_SUCCESS;
  for (libusb_device* device : list.devices()) {
    libusb_device_descriptor descriptor{};
    if (libusb_get_device_descriptor(device, &descriptor) != LIBUSB_SUCCESS ||
        descriptor.idVendor != identity.vendor || descriptor.idProduct != identity.product) {
      continue;
    }
    libusb_device_handle* opened = nullptr;
    if (const int code = libusb_open(device, &opened); code != LIBUSB_SUCCESS) {
      refusal = code;
      continue;
    }
    Handle handle(opened, libusb_close);
    const std::string serial_number = serial_number_of(opened, descriptor.iSerialNumber);
    if (!identity.serial_number.empty() && identity.serial_number != serial_number) {
      continue;
    }
    serial_numbers.push_back(serial_number);
    if (device_ == nullptr) {
      identity_ = identity;
      identity_.serial_number = serial_number;
      device_ = handle.release();
    }
  }
  if (serial_numbers.size() > 1) {
    std::ranges::sort(serial_numbers);  // libusb's order is that of chance
    return failure(fmt::format("{}: found {} such devices, expected one: add :SERIAL, one of {}",
                               name_, serial_numbers.size(), fmt::join(serial_numbers, ", ")));
  }
  if (device_ == nullptr && refusal == LIBUSB_ERROR_ACCESS) {
    return failure(fmt::format(
        "{}: found it, but may not open it: install Penduline's udev rules, or run as root",
        name_));
  }
  if (device_ == nullptr && refusal != LIBUSB_SUCCESS) {
    return tl::unexpected(error("cannot be opened", refusal));
  }
  if (device_ == nullptr) {
    return failure(fmt::format("{}: found no such USB device", name_));
  }
  return {};
}

/// Takes the serial port's two interfaces: control (class 2) and data (class 10).
tl::expected<void, Error> UsbPort::claim() {
  libusb_config_descriptor* raw = nullptr;
  if (const int code = libusb_get_active_config_descriptor(libusb_get_device(device_), &raw);
      code != LIBUSB_SUCCESS) {
    return tl::unexpected(error("has no configuration", code));
  }
  const std::unique_ptr<libusb_config_descriptor, decltype(&libusb_free_config_descriptor)> config(
      raw, libusb_free_config_descriptor);
  for (const libusb_interface& interface : std::span(config->interface, config->bNumInterfaces)) {
    const libusb_interface_descriptor& setting = *interface.altsetting;
    if (setting.bInterfaceClass == LIBUSB_CLASS_COMM) {
      control_interface_ = setting.bInterfaceNumber;
    }
    if (setting.bInterfaceClass != LIBUSB_CLASS_DATA) {
      continue;
    }
    data_interface_ = setting.bInterfaceNumber;
    for (const libusb_endpoint_descriptor& endpoint :
         std::span(setting.endpoint, setting.bNumEndpoints)) {
      const bool in = (endpoint.bEndpointAddress & LIBUSB_ENDPOINT_IN) != 0;
      (in ? in_endpoint_ : out_endpoint_) = endpoint.bEndpointAddress;
    }
  }
  if (control_interface_ < 0 || in_endpoint_ == 0 || out_endpoint_ == 0) {
    return failure(fmt::format("{}: found no serial port (CDC-ACM) in the device", name_));
  }
  libusb_set_auto_detach_kernel_driver(device_, 1);
  // The driver of the control interface holds both.
  int code = libusb_claim_interface(device_, control_interface_);
  control_claimed_ = code == LIBUSB_SUCCESS;
  if (control_claimed_) {
    code = libusb_claim_interface(device_, data_interface_);
    data_claimed_ = code == LIBUSB_SUCCESS;
  }
  if (code == LIBUSB_ERROR_BUSY) {
    return failure(fmt::format("{}: another program has the device", name_));
  }
  if (code != LIBUSB_SUCCESS) {
    return tl::unexpected(error("cannot be claimed", code));
  }
  constexpr std::uint8_t kClassInterfaceOut = 0x21;
  constexpr std::uint8_t kSetControlLineState = 0x22;
  constexpr std::uint16_t kDataTerminalReady = 1;
  constexpr unsigned kPatienceMs = 500;
  libusb_control_transfer(device_, kClassInterfaceOut, kSetControlLineState, kDataTerminalReady,
                          static_cast<std::uint16_t>(control_interface_), nullptr, 0, kPatienceMs);
  return {};
}

UsbPort::~UsbPort() {
  if (data_claimed_) {
    libusb_release_interface(device_, data_interface_);
  }
  if (control_claimed_) {
    libusb_release_interface(device_, control_interface_);  // and the driver takes both again
  }
  if (device_ != nullptr) {
    libusb_close(device_);
  }
  if (context_ != nullptr) {
    libusb_exit(context_);
  }
}

tl::expected<BytePort::Got, Error> UsbPort::read(std::span<std::uint8_t> bytes,
                                                 std::chrono::milliseconds patience) {
  int got = 0;
  const auto timeout_ms = static_cast<unsigned>(std::max<std::int64_t>(patience.count(), 1));
  const int code = libusb_bulk_transfer(device_, in_endpoint_, bytes.data(),
                                        static_cast<int>(bytes.size()), &got, timeout_ms);
  if (code != LIBUSB_SUCCESS && code != LIBUSB_ERROR_TIMEOUT && got == 0) {
    return tl::unexpected(error("gone", code));
  }
  // An empty packet is no end.
  return Got{got > 0 ? Outcome::kBytes : Outcome::kNothingYet, static_cast<std::size_t>(got)};
}

tl::expected<void, Error> UsbPort::write(std::span<const std::uint8_t> bytes) {
  constexpr unsigned kPatienceMs = 1000;
  std::vector<std::uint8_t> buffer(bytes.begin(), bytes.end());  // libusb's is not const
  int sent = 0;
  const int code = libusb_bulk_transfer(device_, out_endpoint_, buffer.data(),
                                        static_cast<int>(buffer.size()), &sent, kPatienceMs);
  if (code != LIBUSB_SUCCESS || static_cast<std::size_t>(sent) != bytes.size()) {
    return tl::unexpected(error("the board takes no commands", code));
  }
  return {};
}

Error UsbPort::error(const char* what, int code) const {
  return {fmt::format("{}: {}: {}", name_, what, libusb_strerror(code))};
}

}  // namespace penduline
