// SPDX-License-Identifier: Apache-2.0
// The kernel's part: usbfs as Linux answers it (drivers/usb/core/devio.c), as far as libusb asks.
#include <fmt/format.h>
#include <sys/ioctl.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstddef>
#include <cstring>
#include <utility>

#include "tests/unit/usb/mocked_usb_board.hpp"

namespace penduline::test {
namespace {

constexpr const char* kDriver = "cdc_acm";
constexpr const char* kProgram = "Penduline";

/// What an ioctl's argument points to, as a copy that goes back when the ioctl is over.
Reference<UMockdevIoctlData> pointed_to(UMockdevIoctlData* data, std::size_t offset,
                                        std::size_t size) {
  return Reference<UMockdevIoctlData>(umockdev_ioctl_data_resolve(data, offset, size, nullptr));
}

template <class Value>
Value value_at(UMockdevIoctlData* argument) {
  Value value{};
  if (const auto data = pointed_to(argument, 0, sizeof value)) {
    std::memcpy(&value, data->data, sizeof value);
  }
  return value;
}

}  // namespace

gboolean MockedUsbBoard::on_ioctl(UMockdevIoctlBase* /*handler*/, UMockdevIoctlClient* client,
                                  gpointer board) {
  const long result = static_cast<MockedUsbBoard*>(board)->serve(client);
  umockdev_ioctl_client_complete(client, std::max(result, -1L),
                                 result < 0 ? static_cast<int>(-result) : 0);
  return TRUE;
}

void MockedUsbBoard::on_closed(UMockdevIoctlBase* /*handler*/, UMockdevIoctlClient* client,
                               gpointer board) {
  auto& self = *static_cast<MockedUsbBoard*>(board);
  const std::lock_guard lock(self.mutex_);
  std::erase_if(self.urbs_, [&](const Urb& urb) { return urb.client == client; });
}

/// The result of an ioctl, or a negative number of errno.
long MockedUsbBoard::serve(UMockdevIoctlClient* client) {
  const gulong request = umockdev_ioctl_client_get_request(client);
  UMockdevIoctlData* const argument = umockdev_ioctl_client_get_arg(client);
  std::unique_lock lock(mutex_);
  switch (request) {
    case USBDEVFS_REAPURBNDELAY:
      return fetch_finished(client, argument, lock);
    case USBDEVFS_DISCARDURB:
      return cancel(client, argument);
    default:
      break;
  }
  if (gone_) {
    return -ENODEV;
  }
  switch (request) {
    case USBDEVFS_GET_CAPABILITIES: {
      const std::uint32_t capabilities = USBDEVFS_CAP_ZERO_PACKET |
                                         USBDEVFS_CAP_NO_PACKET_SIZE_LIM |
                                         USBDEVFS_CAP_REAP_AFTER_DISCONNECT;
      std::memcpy(pointed_to(argument, 0, sizeof capabilities)->data, &capabilities,
                  sizeof capabilities);
      return 0;
    }
    case USBDEVFS_SUBMITURB:
      return submit(client, argument);
    default:
      return serve_interface(request, argument);
  }
}

long MockedUsbBoard::serve_interface(gulong request, UMockdevIoctlData* argument) {
  switch (request) {
    case USBDEVFS_DISCONNECT_CLAIM:
      return claim(value_at<usbdevfs_disconnect_claim>(argument).interface, true);
    case USBDEVFS_CLAIMINTERFACE:
      return claim(value_at<unsigned>(argument), false);
    case USBDEVFS_RELEASEINTERFACE:
      return release(value_at<unsigned>(argument));
    case USBDEVFS_IOCTL: {
      const auto inner = value_at<usbdevfs_ioctl>(argument);
      return inner.ioctl_code == static_cast<int>(USBDEVFS_CONNECT)
                 ? connect_driver(static_cast<unsigned>(inner.ifno))
                 : -ENOTTY;
    }
    default:
      requests_.push_back(fmt::format("an ioctl that is not mocked: {:#x}", request));
      return -ENOTTY;
  }
}

/// cdc_acm has both interfaces, and loses both with either.
long MockedUsbBoard::claim(unsigned interface, bool from_driver) {
  if (from_driver && owners_.at(interface) == kDriver) {
    requests_.push_back(fmt::format("disconnect {}", interface));
    owners_ = {};
  }
  if (!owners_.at(interface).empty()) {
    return -EBUSY;
  }
  requests_.push_back(fmt::format("claim {}", interface));
  owners_.at(interface) = kProgram;
  return 0;
}

long MockedUsbBoard::release(unsigned interface) {
  requests_.push_back(fmt::format("release {}", interface));
  return std::exchange(owners_.at(interface), "") == kProgram ? 0 : -EINVAL;
}

/// cdc_acm knows the control interface, and takes both if both are free.
long MockedUsbBoard::connect_driver(unsigned interface) {
  requests_.push_back(fmt::format("connect {}", interface));
  if (!owners_.at(interface).empty()) {
    return -EBUSY;
  }
  if (interface != 0 || !owners_.at(1).empty()) {
    return 0;
  }
  owners_ = {kDriver, kDriver};
  return 1;
}

long MockedUsbBoard::submit(UMockdevIoctlClient* client, UMockdevIoctlData* argument) {
  Urb urb{.client = client, .data = pointed_to(argument, 0, sizeof(usbdevfs_urb)), .buffer = {}};
  if (const int length = urb.request().buffer_length; length > 0) {
    urb.buffer = pointed_to(urb.data.get(), offsetof(usbdevfs_urb, buffer),
                            static_cast<std::size_t>(length));
  }
  const Transfer transfer = urb.is_read() ? Transfer::kRead : Transfer::kWrite;
  const bool bulk = urb.request().type == USBDEVFS_URB_TYPE_BULK;
  urbs_.push_back(std::move(urb));
  if (bulk && unplugging_ && unplugging_->transfer == transfer) {
    urbs_.back().finish(unplugging_->status, unplugging_->bytes);
    gone_ = true;
  }
  return 0;
}

/// What is done already cannot be cancelled, and is still to be fetched.
long MockedUsbBoard::cancel(UMockdevIoctlClient* client, UMockdevIoctlData* argument) {
  gulong address = 0;
  std::memcpy(&address, argument->data, sizeof address);
  const auto urb = std::ranges::find_if(urbs_, [&](const Urb& one) {
    return one.client == client && one.data->client_addr == address && !one.done;
  });
  if (urb == urbs_.end()) {
    return -EINVAL;
  }
  if (urb->is_read() && at_cancelling_) {
    const AtCancelling now = *std::exchange(at_cancelling_, std::nullopt);
    urb->finish(now.moment == Moment::kBeforeCancelled ? 0 : -ENOENT, now.bytes);
    return now.moment == Moment::kBeforeCancelled ? -EINVAL : 0;
  }
  urb->finish(-ENOENT, "");
  return 0;
}

/// Hands the first transfer out that is done. The node that stands for the device is a file, which
/// is always ready, so the waiting is done here.
long MockedUsbBoard::fetch_finished(UMockdevIoctlClient* client, UMockdevIoctlData* argument,
                                    std::unique_lock<std::mutex>& lock) {
  constexpr std::chrono::milliseconds kWait{1};
  const auto finished = [&] {
    for (Urb& urb : urbs_) {
      if (urb.client == client && !urb.done) {
        advance(urb);
      }
    }
    return std::ranges::find_if(urbs_,
                                [&](const Urb& urb) { return urb.client == client && urb.done; });
  };
  auto urb = finished();
  if (urb == urbs_.end() && !gone_) {
    news_.wait_for(lock, kWait);
    urb = finished();
  }
  if (urb == urbs_.end()) {
    return gone_ ? -ENODEV : -EAGAIN;
  }
  const auto place = pointed_to(argument, 0, sizeof(void*));
  umockdev_ioctl_data_set_ptr(place.get(), 0, urb->data.get());
  urbs_.erase(urb);
  return 0;
}

}  // namespace penduline::test
