// SPDX-License-Identifier: Apache-2.0
// What the board does with transfers, and what a test has it do.
#include "tests/unit/usb/mocked_usb_board.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <utility>

namespace penduline::test {

MockedUsbBoard::MockedUsbBoard(MockedBus& bus, PluggedDevice device)
    : bus_(bus), device_(std::move(device)) {
  if (device_.descriptors.empty()) {
    device_.descriptors = pico_descriptors(device_.identity);
  }
  g_signal_connect(handler_.get(), "handle-ioctl", G_CALLBACK(on_ioctl), this);
  g_signal_connect(handler_.get(), "client-vanished", G_CALLBACK(on_closed), this);
  bus_.plug_in(device_);
  umockdev_testbed_attach_ioctl(bus_.testbed(), MockedBus::node(device_).c_str(), handler_.get(),
                                nullptr);
}

MockedUsbBoard::~MockedUsbBoard() {
  unplug();
  umockdev_testbed_detach_ioctl(bus_.testbed(), MockedBus::node(device_).c_str(), nullptr);
  g_signal_handlers_disconnect_by_data(handler_.get(), this);
}

void MockedUsbBoard::send(const std::string& bytes) {
  const std::lock_guard lock(mutex_);
  to_send_.push_back(bytes);
  news_.notify_all();
}

void MockedUsbBoard::answer_by(std::function<std::string(const std::string&)> answer) {
  const std::lock_guard lock(mutex_);
  answer_ = std::move(answer);
}

std::string MockedUsbBoard::received() const {
  const std::lock_guard lock(mutex_);
  return received_;
}

std::vector<std::string> MockedUsbBoard::requests() const {
  const std::lock_guard lock(mutex_);
  return requests_;
}

std::string MockedUsbBoard::owner(unsigned interface) const {
  const std::lock_guard lock(mutex_);
  return owners_.at(interface);
}

void MockedUsbBoard::give_to(unsigned interface, const std::string& owner) {
  const std::lock_guard lock(mutex_);
  owners_.at(interface) = owner;
}

void MockedUsbBoard::stop_taking() {
  const std::lock_guard lock(mutex_);
  taking_ = false;
}

void MockedUsbBoard::send_at_cancelling(const std::string& bytes, Moment moment) {
  const std::lock_guard lock(mutex_);
  at_cancelling_ = {bytes, moment};
}

void MockedUsbBoard::unplug() {
  {
    const std::lock_guard lock(mutex_);
    gone_ = true;
  }
  if (std::exchange(listed_, false)) {
    bus_.unplug(device_);
  }
}

void MockedUsbBoard::unplug_during(Transfer transfer, int status, const std::string& bytes) {
  const std::lock_guard lock(mutex_);
  unplugging_ = {transfer, status, bytes};
}

usbdevfs_urb& MockedUsbBoard::Urb::request() const {
  return *reinterpret_cast<usbdevfs_urb*>(data->data);
}

bool MockedUsbBoard::Urb::is_read() const {
  return request().type == USBDEVFS_URB_TYPE_BULK && (request().endpoint & 0x80) != 0;
}

void MockedUsbBoard::Urb::finish(int status, const std::string& bytes) {
  done = true;
  request().status = status;
  request().actual_length = static_cast<int>(bytes.size());
  if (buffer) {
    std::ranges::copy(bytes, buffer->data);
  }
}

/// Does a transfer, if it can be done now.
void MockedUsbBoard::advance(Urb& urb) {
  if (gone_) {
    urb.finish(-ESHUTDOWN, "");
  } else if (urb.request().type == USBDEVFS_URB_TYPE_CONTROL) {
    control(urb);
  } else if (urb.is_read()) {
    if (!to_send_.empty()) {
      std::string& bytes = to_send_.front();
      const std::string now =
          bytes.substr(0, static_cast<std::size_t>(urb.request().buffer_length));
      bytes.erase(0, now.size());
      if (bytes.empty()) {
        to_send_.pop_front();
      }
      urb.finish(0, now);
    }
  } else if (taking_) {
    const std::string bytes(urb.buffer->data, urb.buffer->data + urb.buffer->data_len);
    received_ += bytes;
    if (std::string answer = answer_ ? answer_(bytes) : ""; !answer.empty()) {
      to_send_.push_back(std::move(answer));
    }
    urb.finish(0, bytes);
  }
}

/// Answers requests for strings, and notes what is said about the serial port's lines.
void MockedUsbBoard::control(Urb& urb) {
  constexpr std::size_t kSetupBytes = 8;
  constexpr std::uint8_t kGetDescriptor = 6;
  constexpr std::uint8_t kStringType = 3;
  constexpr std::uint8_t kSetControlLineState = 0x22;
  const std::uint8_t* const setup = urb.buffer->data;
  const std::uint8_t type = setup[0];
  const std::uint8_t request = setup[1];
  if (type == 0x80 && request == kGetDescriptor && setup[3] == kStringType) {
    const std::string answer =
        setup[2] == 0 ? kLanguages : string_descriptor(device_.identity.serial_number);
    urb.finish(0, "");
    std::ranges::copy(answer, urb.buffer->data + kSetupBytes);
    urb.request().actual_length = static_cast<int>(answer.size());
  } else if (type == 0x21 && request == kSetControlLineState) {
    requests_.push_back(fmt::format("line state {} of {}", setup[2], setup[4]));
    urb.finish(0, "");
  } else {
    urb.finish(-EPIPE, "");
  }
}

}  // namespace penduline::test
