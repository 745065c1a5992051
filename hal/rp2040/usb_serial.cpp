// SPDX-License-Identifier: Apache-2.0
// USB requests and packets (USB 2.0 chapters 8 and 9; RP2040 data sheet 4.1.2).
#include "hal/rp2040/usb_serial.hpp"

#include <algorithm>
#include <string_view>

#include "hal/rp2040/registers.hpp"
#include "hal/rp2040/usb_controller.hpp"

namespace penduline::rp2040 {
namespace {

using usb::Direction;

constexpr std::size_t kPacketBytes = usb::kPacketBytes;
constexpr std::uint8_t kIn = 0x80;

// Standard requests (USB 2.0, table 9-4).
constexpr std::uint8_t kGetStatus = 0;
constexpr std::uint8_t kClearFeature = 1;
constexpr std::uint8_t kSetFeature = 3;
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

bool UsbSerial::start(const std::array<std::uint8_t, kUniqueIdBytes>& unique_id) {
  constexpr std::uint32_t kToPhy = 0x9;
  constexpr std::uint32_t kForceVbus = 0xc;
  constexpr std::uint32_t kInterruptEachControlBuffer = 1U << 29U;
  constexpr std::uint32_t kPullUp = 1U << 16U;
  constexpr std::string_view kDigits = "0123456789ABCDEF";
  for (std::size_t i = 0; i < unique_id.size(); ++i) {
    serial_number_[2 * i] = kDigits[unique_id[i] >> 4U];
    serial_number_[2 * i + 1] = kDigits[unique_id[i] & 0xfU];
  }
  if (!restart_peripheral(resets::kUsb)) {
    return false;
  }
  for (std::uint32_t word = 0; word < usb::kMemoryBytes; word += 4) {
    reg(usb::kMemory + word) = 0;
  }
  reg(usb::kMuxing) = kToPhy;
  reg(usb::kPower) = kForceVbus;
  reg(usb::kMainCtrl) = 1;
  reg(usb::kSieCtrl) = kInterruptEachControlBuffer;
  reg(usb::kInterruptEnable) = usb::kOnBuffer | usb::kOnBusReset | usb::kOnSetup;
  set_bits(usb::kSieCtrl, kPullUp);
  return true;
}

std::size_t UsbSerial::write(std::span<const std::uint8_t> bytes) {
  const std::size_t taken = put_bytes(out_, bytes);
  disable_interrupt(Interrupt::kUsb);
  send_data();
  enable_interrupt(Interrupt::kUsb);
  return taken;
}

std::size_t UsbSerial::read(std::span<std::uint8_t> bytes) {
  const std::size_t given = take_bytes(in_, bytes);
  if (given > 0) {
    disable_interrupt(Interrupt::kUsb);
    open_for_data();
    enable_interrupt(Interrupt::kUsb);
  }
  return given;
}

void UsbSerial::on_interrupt() {
  const std::uint32_t status = rp2040::read(usb::kInterruptStatus);
  if ((status & usb::kOnBusReset) != 0) {
    reg(usb::kSieStatus) = usb::kBusResetSeen;
    reg(usb::kAddress) = 0;
    reg(usb::kBufferStatus) = rp2040::read(usb::kBufferStatus);
    stage_ = Stage::kIdle;
    configure(false);
  }
  // What a transfer has finished belongs to it and not to the request that comes after it.
  if ((status & usb::kOnBuffer) != 0) {
    const std::uint32_t done = rp2040::read(usb::kBufferStatus);
    reg(usb::kBufferStatus) = done;
    if ((done & usb::buffer_bit(0, Direction::kIn)) != 0) {
      on_control_in();
    }
    if ((done & usb::buffer_bit(0, Direction::kOut)) != 0) {
      on_control_out();
    }
    if ((done & usb::buffer_bit(usb::kDataEndpoint, Direction::kIn)) != 0) {
      in_armed_ = false;
      send_data();
    }
    if ((done & usb::buffer_bit(usb::kDataEndpoint, Direction::kOut)) != 0) {
      take_data();
    }
  }
  if ((status & usb::kOnSetup) != 0) {
    reg(usb::kSieStatus) = usb::kSetupSeen;
    on_setup();
  }
}

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
    case kClearFeature:
      if (low_byte(setup.index) == (kIn | usb::kDataEndpoint)) {
        in_data1_ = false;
      }
      return acknowledge();
    case kSetFeature:
    case kSetInterface:
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

void UsbSerial::configure(bool on) {
  configured_ = on;
  in_armed_ = out_armed_ = in_data1_ = out_data1_ = false;
  reg(usb::buffer_ctrl(usb::kDataEndpoint, Direction::kIn)) = 0;
  reg(usb::buffer_ctrl(usb::kDataEndpoint, Direction::kOut)) = 0;
  if (!on) {
    return;
  }
  usb::open_endpoint(usb::kNotifyEndpoint, Direction::kIn, usb::TransferType::kInterrupt,
                     usb::kNotifyBuffer);
  usb::open_endpoint(usb::kDataEndpoint, Direction::kIn, usb::TransferType::kBulk, usb::kInBuffer);
  usb::open_endpoint(usb::kDataEndpoint, Direction::kOut, usb::TransferType::kBulk,
                     usb::kOutBuffer);
  open_for_data();
  send_data();
}

void UsbSerial::send_data() {
  if (!configured_ || in_armed_) {
    return;
  }
  std::array<std::uint8_t, kPacketBytes> packet{};
  const std::size_t length = take_bytes(out_, packet);
  if (length == 0) {
    return;
  }
  in_armed_ = true;
  usb::copy_in(usb::kInBuffer, {packet.data(), length});
  usb::arm(usb::kDataEndpoint, Direction::kIn, length, in_data1_);
  in_data1_ = !in_data1_;
}

void UsbSerial::take_data() {
  constexpr std::uint32_t kLengthMask = 0x3ff;
  out_armed_ = false;
  std::array<std::uint8_t, kPacketBytes> packet{};
  const std::size_t length = std::min<std::size_t>(
      rp2040::read(usb::buffer_ctrl(usb::kDataEndpoint, Direction::kOut)) & kLengthMask,
      packet.size());
  usb::copy_out(usb::kOutBuffer, {packet.data(), length});
  put_bytes(in_, {packet.data(), length});
  open_for_data();
}

/// Lets the host send a packet as soon as there is room for it; until then it is told to wait.
void UsbSerial::open_for_data() {
  constexpr std::size_t kRoom = 256 - kPacketBytes;
  if (!configured_ || out_armed_ || in_.size() > kRoom) {
    return;
  }
  out_armed_ = true;
  usb::arm(usb::kDataEndpoint, Direction::kOut, kPacketBytes, out_data1_);
  out_data1_ = !out_data1_;
}

}  // namespace penduline::rp2040
