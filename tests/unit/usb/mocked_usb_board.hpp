// SPDX-License-Identifier: Apache-2.0
// A board on a mocked bus, with the kernel's part in front of it: usbfs and the driver of its port.
#pragma once

#include <linux/usbdevice_fs.h>
#include <umockdev.h>

#include <array>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "tests/unit/usb/board_descriptors.hpp"
#include "tests/unit/usb/mocked_bus.hpp"

namespace penduline::test {

/// Answers the ioctls of usbfs on a thread of libumockdev's, while a test tells it what to do. It
/// must outlive the ports that are opened on it.
class MockedUsbBoard {
 public:
  /// Plugs it in; with the Pico's descriptors where the device has none.
  explicit MockedUsbBoard(MockedBus& bus, PluggedDevice device = {});
  MockedUsbBoard(const MockedUsbBoard&) = delete;
  MockedUsbBoard& operator=(const MockedUsbBoard&) = delete;
  ~MockedUsbBoard();

  /// Sends bytes in a transfer of their own; "" is a packet of zero length.
  void send(const std::string& bytes);
  /// What it sends when it is sent something; is called on another thread.
  void answer_by(std::function<std::string(const std::string&)> answer);
  /// All that was sent to it.
  [[nodiscard]] std::string received() const;

  /// What was asked for beside transfers of data, in order: "disconnect 0", "claim 0", "line state
  /// 1 of 0", "release 0", "connect 0", where 0 is an interface.
  [[nodiscard]] std::vector<std::string> requests() const;
  /// Who has the interface: "cdc_acm", "Penduline", another program, or nobody: "".
  [[nodiscard]] std::string owner(unsigned interface) const;
  void give_to(unsigned interface, const std::string& owner);

  /// Takes nothing more that is sent to it.
  void stop_taking();
  /// Sends the bytes when a transfer that waits for some is cancelled: with the cancelled transfer,
  /// or in it just before it could be cancelled.
  enum class Moment { kWithCancelled, kBeforeCancelled };
  void send_at_cancelling(const std::string& bytes, Moment moment);

  /// It has gone, and is no longer listed.
  void unplug();
  /// It goes while the next transfer to or from it waits, which ends by `status`, a negative number
  /// of errno, with what bytes have come. Until `unplug` it is still listed.
  enum class Transfer { kRead, kWrite };
  void unplug_during(Transfer transfer, int status, const std::string& bytes = "");

 private:
  using Data = Reference<UMockdevIoctlData>;
  /// A transfer that the kernel has been given, and that has not been fetched from it.
  struct Urb {
    UMockdevIoctlClient* client;
    Data data;
    Data buffer;  ///< none where it is empty
    bool done = false;

    [[nodiscard]] usbdevfs_urb& request() const;
    [[nodiscard]] bool is_read() const;
    void finish(int status, const std::string& bytes);
  };

  static gboolean on_ioctl(UMockdevIoctlBase* handler, UMockdevIoctlClient* client, gpointer board);
  static void on_closed(UMockdevIoctlBase* handler, UMockdevIoctlClient* client, gpointer board);
  long serve(UMockdevIoctlClient* client);
  long serve_interface(gulong request, UMockdevIoctlData* argument);
  long claim(unsigned interface, bool from_driver);
  long release(unsigned interface);
  long connect_driver(unsigned interface);
  long submit(UMockdevIoctlClient* client, UMockdevIoctlData* argument);
  long cancel(UMockdevIoctlClient* client, UMockdevIoctlData* argument);
  long fetch_finished(UMockdevIoctlClient* client, UMockdevIoctlData* argument,
                      std::unique_lock<std::mutex>& lock);
  void advance(Urb& urb);
  void control(Urb& urb);

  MockedBus& bus_;
  PluggedDevice device_;
  Reference<UMockdevIoctlBase> handler_{umockdev_ioctl_base_new()};
  bool listed_ = true;  ///< in /sys

  mutable std::mutex mutex_;  ///< for all that follows
  std::condition_variable news_;
  std::deque<Urb> urbs_;
  std::deque<std::string> to_send_;
  std::string received_;
  std::function<std::string(const std::string&)> answer_;
  std::vector<std::string> requests_;
  std::array<std::string, 2> owners_ = {"cdc_acm", "cdc_acm"};
  bool taking_ = true;
  struct AtCancelling {
    std::string bytes;
    Moment moment;
  };
  std::optional<AtCancelling> at_cancelling_;
  struct Unplugging {
    Transfer transfer;
    int status;
    std::string bytes;
  };
  std::optional<Unplugging> unplugging_;
  bool gone_ = false;
};

}  // namespace penduline::test
