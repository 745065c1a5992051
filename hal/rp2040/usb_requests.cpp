// SPDX-License-Identifier: Apache-2.0
// What the host asks of the device on endpoint 0 (USB 2.0 chapters 8 and 9).
#include <algorithm>
#include <string_view>

#include "hal/rp2040/registers.hpp"
#include "hal/rp2040/usb_controller.hpp"
#include "hal/rp2040/usb_serial.hpp"

namespace penduline::rp2040 {
namespace {

using usb::Direction;

constexpr std::size_t kPacketBytes = usb::kPacketBytes;

constexpr std::uint8_t kIn = 0x80;

// Standard requests (USB 2.0, table 9-4).
constexpr std::uint8_t kGetStatus = 0;
constexpr std::uint8_t kClearFeature = 1;
constexpr std::uint8_t kSetAddress = 5;
constexpr std::uint8_t kGetDescriptor = 6;
constexpr std::uint8_t kGetConfiguration = 8;
constexpr std::uint8_t kSetConfiguration = 9;
constexpr std::uint8_t kGetInterface = 10;
constexpr std::uint8_t kSetInterface = 11;
// Requests of a serial port (PSTN 1.2, table 13).
constexpr std::uint8_t kSetLineCoding = 0x20;
constexpr std::uint8_t kGetLineCoding = 0x21;
constexpr std::uint8_t kSetLineState = 0x22;
constexpr std::uint8_t kSendBreak = 0x23;

constexpr std::uint8_t low_byte(std::uint16_t value) {
  return static_cast<std::uint8_t>(value & 0xffU);
}
constexpr std::uint8_t high_byte(std::uint16_t value) {
  return static_cast<std::uint8_t>(value >> 8U);
}

}  // namespace

void UsbSerial::on_setup() {
  std::array<std::uint8_t, 8> raw{};
  usb::copy_out(0, raw);
  const auto word = [&](std::size_t at) {
    return static_cast<std::uint16_t>(raw[at] | (raw[at + 1] << 8U));
  };
  const Setup setup{
      .type = raw[0], .request = raw[1], .value = word(2), .index = word(4), .length = word(6)};
  constexpr std::uint8_t kClassMask = 0x60;
  constexpr std::uint8_t kStandard = 0x00;
  constexpr std::uint8_t kClass = 0x20;
  stage_ = Stage::kIdle;
  new_address_ = 0;
  control_data1_ = true;  // the stage after the setup packet begins with DATA1
  switch (setup.type & kClassMask) {
    case kStandard:
      return on_standard_request(setup);
    case kClass:
      return on_class_request(setup);
    default:
      return usb::stall_control();
  }
}

void UsbSerial::on_standard_request(const Setup& setup) {
  switch (setup.request) {
    case kGetStatus:
      reply_[0] = reply_[1] = 0;
      return give({reply_.data(), 2}, setup);
    case kClearFeature:  // of an endpoint: its halt, and its packets begin with DATA0 (9.4.5)
      if (low_byte(setup.index) == (kIn | usb::kDataEndpoint)) {
        restart_data_in();
      } else if (low_byte(setup.index) == usb::kDataEndpoint) {
        restart_data_out();
      }
      return acknowledge();
    case kSetInterface:  // the same for all of its endpoints (9.1.1.5)
      if (setup.value != 0 || setup.index > usb::kDataInterface) {
        return usb::stall_control();
      }
      if (setup.index == usb::kDataInterface) {
        restart_data_in();
        restart_data_out();
      }
      return acknowledge();
    case kSetAddress:
      new_address_ = low_byte(setup.value);
      return acknowledge();
    case kGetDescriptor:
      return give_descriptor(setup);
    case kGetConfiguration:
      reply_[0] = configured_ ? 1 : 0;
      return give({reply_.data(), 1}, setup);
    case kSetConfiguration:
      if (setup.value > 1) {
        return usb::stall_control();
      }
      configure(setup.value == 1);
      return acknowledge();
    case kGetInterface:
      reply_[0] = 0;
      return give({reply_.data(), 1}, setup);
    default:
      return usb::stall_control();
  }
}

void UsbSerial::on_class_request(const Setup& setup) {
  constexpr std::array<std::uint8_t, 4> k1200Baud = {0xb0, 0x04, 0, 0};
  switch (setup.request) {
    case kSetLineCoding:
      stage_ = Stage::kDataOut;
      return usb::arm(0, Direction::kOut, kPacketBytes, control_data1_);
    case kGetLineCoding:
      return give(line_coding_, setup);
    case kSetLineState:
      if ((setup.value & 1U) == 0 &&
          std::equal(k1200Baud.begin(), k1200Baud.end(), line_coding_.begin())) {
        touched_.store(true, std::memory_order_relaxed);
      }
      return acknowledge();
    case kSendBreak:
      return acknowledge();
    default:
      return usb::stall_control();
  }
}

void UsbSerial::give_descriptor(const Setup& setup) {
  constexpr std::uint8_t kDevice = 1;
  constexpr std::uint8_t kConfiguration = 2;
  constexpr std::uint8_t kString = 3;
  switch (high_byte(setup.value)) {
    case kDevice:
      return give(usb::kDeviceDescriptor, setup);
    case kConfiguration:
      return give(usb::kConfigurationDescriptor, setup);
    case kString:
      return give_string(setup);
    default:
      return usb::stall_control();  // a device qualifier, say: we are full speed only
  }
}

void UsbSerial::give_string(const Setup& setup) {
  constexpr std::uint8_t kStringType = 3;
  constexpr std::uint8_t kEnglish[] = {4, kStringType, 0x09, 0x04};
  std::string_view text;
  switch (low_byte(setup.value)) {
    case 0:
      return give(kEnglish, setup);
    case 1:
      text = usb::kMaker;
      break;
    case 2:
      text = usb::kProduct;
      break;
    case 3:
      text = {serial_number_.data(), serial_number_.size()};
      break;
    default:
      return usb::stall_control();
  }
  const std::size_t length = 2 + 2 * text.size();
  reply_[0] = static_cast<std::uint8_t>(length);
  reply_[1] = kStringType;
  for (std::size_t i = 0; i < text.size(); ++i) {
    reply_[2 + 2 * i] = static_cast<std::uint8_t>(text[i]);
    reply_[3 + 2 * i] = 0;
  }
  give({reply_.data(), length}, setup);
}

void UsbSerial::give(std::span<const std::uint8_t> reply, const Setup& setup) {
  const std::size_t length = std::min<std::size_t>(reply.size(), setup.length);
  // A reply that is shorter than asked for and ends with a full packet is ended by an empty one.
  empty_packet_last_ = length < setup.length && length > 0 && length % kPacketBytes == 0;
  to_give_ = reply.first(length);
  stage_ = Stage::kDataIn;
  give_next();
}

void UsbSerial::give_next() {
  const auto packet = to_give_.first(std::min(to_give_.size(), kPacketBytes));
  to_give_ = to_give_.subspan(packet.size());
  if (packet.size() < kPacketBytes) {
    empty_packet_last_ = false;
  }
  usb::copy_in(usb::kControlBuffer, packet);
  usb::arm(0, Direction::kIn, packet.size(), control_data1_);
  control_data1_ = !control_data1_;
}

/// The status stage of a request without data to the host.
void UsbSerial::acknowledge() {
  stage_ = Stage::kStatusIn;
  usb::arm(0, Direction::kIn, 0, true);
}

void UsbSerial::on_control_in() {
  if (stage_ == Stage::kStatusIn) {
    stage_ = Stage::kIdle;
    if (new_address_ != 0) {
      reg(usb::kAddress) = new_address_;  // from the next transfer on, not for this one
      new_address_ = 0;
    }
    return;
  }
  if (stage_ != Stage::kDataIn) {
    return;
  }
  if (!to_give_.empty() || empty_packet_last_) {
    give_next();
    return;
  }
  stage_ = Stage::kStatusOut;
  usb::arm(0, Direction::kOut, 0, true);
}

void UsbSerial::on_control_out() {
  if (stage_ == Stage::kDataOut) {
    usb::copy_out(usb::kControlBuffer, line_coding_);
    acknowledge();
  }
}

}  // namespace penduline::rp2040
