// SPDX-License-Identifier: Apache-2.0
// Devices in libumockdev's words: P path, N node, E property, A attribute, H the same in
// hexadecimal.
#include "tests/unit/usb/mocked_bus.hpp"

#include <fmt/format.h>
#include <linux/capability.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace penduline::test {
namespace {

constexpr const char* kRootHub = "/devices/pci0000:00/0000:00:14.0/usb1";

std::string path_of(const PluggedDevice& device) {
  return fmt::format("{}/{}", kRootHub, device.port);
}
std::string sys_path_of(const PluggedDevice& device) {
  return "/sys" + path_of(device);
}

std::string hexadecimal(const std::string& bytes) {
  std::string text;
  for (const char byte : bytes) {
    text += fmt::format("{:02X}", static_cast<unsigned char>(byte));
  }
  return text;
}

struct Capabilities {
  __user_cap_header_struct header{.version = _LINUX_CAPABILITY_VERSION_3, .pid = 0};
  std::array<__user_cap_data_struct, _LINUX_CAPABILITY_U32S_3> data{};
};

/// Those of this thread.
Capabilities own_capabilities() {
  Capabilities own;
  ::syscall(SYS_capget, &own.header, own.data.data());
  return own;
}

}  // namespace

MockedBus::MockedBus() {
  testbed_.reset(umockdev_testbed_new());
  if (umockdev_in_mock_environment() == FALSE) {
    throw std::runtime_error(
        "found no mock environment, expected LD_PRELOAD=libumockdev-preload.so.0: run it by ctest");
  }
  add(
      fmt::format("P: {}\n"
                  "N: bus/usb/001/001\n"
                  "E: DEVNAME=/dev/bus/usb/001/001\nE: DEVTYPE=usb_device\nE: SUBSYSTEM=usb\n"
                  "E: MAJOR=189\nE: MINOR=0\nE: BUSNUM=001\nE: DEVNUM=001\n"
                  "A: busnum=1\nA: devnum=1\nA: speed=480\nA: bConfigurationValue=1\n"
                  "A: idVendor=1d6b\nA: idProduct=0002\n"
                  "H: descriptors=12010002090001406B1D020001060302010109021900010100E0000904000001"
                  "090000000705810304000C\n\n",
                  kRootHub));
}

void MockedBus::plug_in(const PluggedDevice& device) {
  std::string description = fmt::format(
      "P: {}\n"
      "N: bus/usb/001/{:03}\n"
      "E: DEVNAME={}\nE: DEVTYPE=usb_device\nE: SUBSYSTEM=usb\n"
      "E: MAJOR=189\nE: MINOR={}\nE: BUSNUM=001\nE: DEVNUM={:03}\n"
      "A: busnum=1\nA: devnum={}\nA: speed=12\nA: bConfigurationValue=1\n"
      "A: idVendor={:04x}\nA: idProduct={:04x}\n",
      path_of(device), device.address, node(device), device.address - 1, device.address,
      device.address, device.identity.vendor, device.identity.product);
  if (!device.product.empty()) {
    description += "A: product=" + device.product + "\n";
  }
  if (!device.identity.serial_number.empty()) {
    description += "A: serial=" + device.identity.serial_number + "\n";
  }
  if (!device.descriptors.empty()) {
    description += "H: descriptors=" + hexadecimal(device.descriptors) + "\n";
  }
  add(description + "\n");
  umockdev_testbed_uevent(testbed(), sys_path_of(device).c_str(), "add");
}

void MockedBus::unplug(const PluggedDevice& device) {
  const auto [begin, end] = children_.equal_range(device.port);
  std::for_each(std::reverse_iterator(end), std::reverse_iterator(begin),
                [&](const auto& child) { remove(child.second); });
  children_.erase(device.port);
  remove(sys_path_of(device));
}

void MockedBus::add_serial_port(const PluggedDevice& device, const std::string& name) {
  const std::string interface = fmt::format("{}/{}:1.0", path_of(device), device.port);
  add(fmt::format("P: {}\nE: DEVTYPE=usb_interface\nE: SUBSYSTEM=usb\n\n", interface));
  const std::string tty = fmt::format("{}/tty/{}", interface, name);
  add(
      fmt::format("P: {}\nN: {}\nE: DEVNAME=/dev/{}\nE: SUBSYSTEM=tty\n"
                  "E: MAJOR=166\nE: MINOR=0\nA: dev=166:0\n\n",
                  tty, name, name));
  children_.emplace(device.port, "/sys" + interface);
  children_.emplace(device.port, "/sys" + tty);
}

void MockedBus::make_file_of(const std::string& name) const {
  const std::unique_ptr<char, decltype(&g_free)> root(umockdev_testbed_get_root_dir(testbed()),
                                                      g_free);
  const std::filesystem::path node = std::filesystem::path(root.get()) / "dev" / name;
  std::filesystem::remove(node);
  std::ofstream{node};
}

void MockedBus::add_platform_port(const std::string& name) {
  add(
      fmt::format("P: /devices/platform/serial8250/tty/{}\nN: {}\nE: DEVNAME=/dev/{}\n"
                  "E: SUBSYSTEM=tty\nE: MAJOR=4\nE: MINOR=64\nA: dev=4:64\n\n",
                  name, name, name));
}

int MockedBus::board_end(const std::string& name) const {
  return umockdev_testbed_get_dev_fd(testbed(), ("/dev/" + name).c_str());
}

void MockedBus::set_attribute(const PluggedDevice& device, const std::string& name,
                              const std::string& value) {
  umockdev_testbed_set_attribute(testbed(), sys_path_of(device).c_str(), name.c_str(),
                                 value.c_str());
}

void MockedBus::forbid(const std::string& node) {
  if (::chmod(node.c_str(), 0) != 0) {
    throw std::runtime_error("cannot forbid " + node);
  }
}

std::string MockedBus::node(const PluggedDevice& device) {
  return fmt::format("/dev/bus/usb/001/{:03}", device.address);
}

void MockedBus::add(const std::string& description) {
  GError* error = nullptr;
  if (umockdev_testbed_add_from_string(testbed(), description.c_str(), &error) == FALSE) {
    const std::unique_ptr<GError, decltype(&g_error_free)> owned(error, g_error_free);
    throw std::runtime_error(owned->message);
  }
}

void MockedBus::remove(const std::string& sys_path) {
  umockdev_testbed_uevent(testbed(), sys_path.c_str(), "remove");
  umockdev_testbed_remove_device(testbed(), sys_path.c_str());
}

WithoutPrivileges::WithoutPrivileges() {
  auto [header, capabilities] = own_capabilities();
  before_ = capabilities[0].effective;
  capabilities[0].effective &= ~(CAP_TO_MASK(CAP_DAC_OVERRIDE) | CAP_TO_MASK(CAP_DAC_READ_SEARCH));
  ::syscall(SYS_capset, &header, capabilities.data());
}

WithoutPrivileges::~WithoutPrivileges() {
  auto [header, capabilities] = own_capabilities();
  capabilities[0].effective = before_;
  ::syscall(SYS_capset, &header, capabilities.data());
}

}  // namespace penduline::test
