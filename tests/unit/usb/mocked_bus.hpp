// SPDX-License-Identifier: Apache-2.0
// A made-up /sys and /dev in which a test plugs USB devices in and out, by libumockdev.
#pragma once

#include <umockdev.h>

#include <cstdint>
#include <map>
#include <memory>
#include <string>

#include "hal/linux/usb_identity.hpp"

namespace penduline::test {

struct GObjectUnref {
  void operator()(gpointer object) const { g_object_unref(object); }
};

/// Keeps one reference of an object of GLib's.
template <class Object>
using Reference = std::unique_ptr<Object, GObjectUnref>;

/// A device as it stands in /sys.
struct PluggedDevice {
  std::string port = "1-1";  ///< of the bus, where it is plugged in
  UsbIdentity identity{.vendor = kPendulineVendor,
                       .product = kPendulineProduct,
                       .serial_number = "E6605838831B2C21"};
  std::string product = "Penduline";  ///< what it calls itself; "": it has no such string
  int address = 2;                    ///< the number that the bus has given it
  std::string descriptors{};          ///< device and configuration, as it answers them
};

class MockedBus {
 public:
  /// A bus with nothing on it but its root hub. Throws where the program runs without libumockdev's
  /// preloaded library.
  MockedBus();

  void plug_in(const PluggedDevice& device);
  void unplug(const PluggedDevice& device);

  /// The kernel's driver has made a serial port of a device that is plugged in.
  void add_serial_port(const PluggedDevice& device, const std::string& name);
  /// Puts an empty file in the place of a serial port, which otherwise is a pseudo-terminal:
  /// libumockdev's realpath() destroys memory where a node leads out of its /dev.
  void make_file_of(const std::string& name) const;
  /// A serial port of the computer's own.
  void add_platform_port(const std::string& name);
  /// The board's end of a serial port that has been added.
  [[nodiscard]] int board_end(const std::string& name) const;

  /// An attribute of a device in /sys, as it stands there.
  void set_attribute(const PluggedDevice& device, const std::string& name,
                     const std::string& value);
  /// Takes the permission to open it from everybody: "/dev/ttyACM0".
  static void forbid(const std::string& node);

  [[nodiscard]] UMockdevTestbed* testbed() const { return testbed_.get(); }
  /// "/dev/bus/usb/001/002".
  [[nodiscard]] static std::string node(const PluggedDevice& device);

 private:
  void add(const std::string& description);
  void remove(const std::string& sys_path);

  Reference<UMockdevTestbed> testbed_;
  std::multimap<std::string, std::string> children_;  ///< of a port's device, by their paths
};

/// As long as it lives, this thread may not do more with files than their permissions say, though
/// it may be root's.
class WithoutPrivileges {
 public:
  WithoutPrivileges();
  WithoutPrivileges(const WithoutPrivileges&) = delete;
  WithoutPrivileges& operator=(const WithoutPrivileges&) = delete;
  ~WithoutPrivileges();

 private:
  std::uint32_t before_;
};

}  // namespace penduline::test
