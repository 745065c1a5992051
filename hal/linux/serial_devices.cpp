// SPDX-License-Identifier: Apache-2.0
// Asks udev for serial ports, and chooses among them.
#include "hal/linux/serial_devices.hpp"

#include <fmt/format.h>
#include <libudev.h>

#include <algorithm>
#include <iterator>
#include <memory>
#include <utility>

#include "hal/error.hpp"

namespace penduline {
namespace {

using Udev = std::unique_ptr<udev, decltype(&udev_unref)>;
using Enumeration = std::unique_ptr<udev_enumerate, decltype(&udev_enumerate_unref)>;
using Device = std::unique_ptr<udev_device, decltype(&udev_device_unref)>;

/// Fit to be printed: a device may say what it likes of itself.
std::string attribute(udev_device* device, const char* name) {
  const char* value = udev_device_get_sysattr_value(device, name);
  return value == nullptr ? "" : one_line(value);
}

/// The device of a tty that is a USB device's; an empty path otherwise.
SerialDevice device_of(udev_device* tty) {
  SerialDevice found;
  const char* path = udev_device_get_devnode(tty);
  // The parent belongs to its child.
  udev_device* usb = udev_device_get_parent_with_subsystem_devtype(tty, "usb", "usb_device");
  if (path == nullptr || usb == nullptr) {
    return found;
  }
  if (const auto identity = parse_usb_identity(
          fmt::format("{}:{}", attribute(usb, "idVendor"), attribute(usb, "idProduct")))) {
    found.path = path;
    found.identity = *identity;
    found.identity.serial_number = attribute(usb, "serial");
    found.product = attribute(usb, "product");
  }
  return found;
}

std::string list(const std::vector<SerialDevice>& devices) {
  std::string text;
  for (const SerialDevice& device : devices) {
    text += (text.empty() ? "" : ", ") + device.text();
  }
  return text.empty() ? "none" : text;
}

}  // namespace

bool SerialDevice::is_st_link() const {
  constexpr std::uint16_t kStMicroelectronics = 0x0483;
  constexpr std::uint16_t kFirstStLinkWithPort = 0x374b;
  constexpr std::uint16_t kLastStLink = 0x3757;
  return identity.vendor == kStMicroelectronics && identity.product >= kFirstStLinkWithPort &&
         identity.product <= kLastStLink;
}

std::string SerialDevice::text() const {
  return fmt::format("{} ({:04x}:{:04x}{}{}{}{})", path, identity.vendor, identity.product,
                     product.empty() ? "" : " ", product, identity.serial_number.empty() ? "" : " ",
                     identity.serial_number);
}

std::vector<SerialDevice> serial_devices() {
  std::vector<SerialDevice> devices;
  const Udev context(udev_new(), udev_unref);
  if (!context) {
    return devices;
  }
  const Enumeration enumeration(udev_enumerate_new(context.get()), udev_enumerate_unref);
  udev_enumerate_add_match_subsystem(enumeration.get(), "tty");
  // Those of USB's drivers; to look at all others, dozens of them, takes far longer.
  udev_enumerate_add_match_sysname(enumeration.get(), "ttyACM*");
  udev_enumerate_add_match_sysname(enumeration.get(), "ttyUSB*");
  udev_enumerate_scan_devices(enumeration.get());
  for (udev_list_entry* entry = udev_enumerate_get_list_entry(enumeration.get()); entry != nullptr;
       entry = udev_list_entry_get_next(entry)) {
    const Device tty(udev_device_new_from_syspath(context.get(), udev_list_entry_get_name(entry)),
                     udev_device_unref);
    if (SerialDevice found = tty ? device_of(tty.get()) : SerialDevice(); !found.path.empty()) {
      devices.push_back(std::move(found));
    }
  }
  std::ranges::sort(devices, {}, &SerialDevice::path);
  return devices;
}

AutoChoice choose_board(const std::vector<SerialDevice>& devices, std::string_view serial_number) {
  const auto those = [&](auto is) {
    std::vector<SerialDevice> found;
    std::ranges::copy_if(devices, std::back_inserter(found), [&](const SerialDevice& device) {
      return is(device) &&
             (serial_number.empty() || device.identity.serial_number == serial_number);
    });
    return found;
  };
  std::vector<SerialDevice> boards = those([](const auto& one) { return one.is_penduline(); });
  if (boards.empty()) {
    boards = those([](const auto& one) { return one.is_st_link(); });
  }
  if (boards.size() == 1) {
    return {.path = boards.front().path};
  }
  if (boards.empty()) {
    return {.reason = fmt::format(
                "found no board: looked for a serial port of the USB device {:04x}:{:04x}{}{}, or "
                "of an ST-Link; USB serial ports seen: {}",
                kPendulineVendor, kPendulineProduct, serial_number.empty() ? "" : " numbered ",
                serial_number, list(devices))};
  }
  return {.reason = fmt::format("found {} boards, expected one: say which by auto:SERIAL or "
                                "serial:PATH: {}",
                                boards.size(), list(boards))};
}

}  // namespace penduline
