// SPDX-License-Identifier: Apache-2.0
// The serial port's data and the controller's interrupts (RP2040 data sheet 4.1.2).
#include "hal/rp2040/usb_serial.hpp"

#include <algorithm>
#include <string_view>
#include <utility>

#include "hal/rp2040/registers.hpp"
#include "hal/rp2040/usb_controller.hpp"

namespace penduline::rp2040 {
namespace {

using usb::Direction;

constexpr std::size_t kPacketBytes = usb::kPacketBytes;

constexpr std::uint32_t kInterrupts = usb::kOnBuffer | usb::kOnBusReset | usb::kOnSetup;

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
  reg(usb::kInterruptEnable) = kInterrupts;
  set_bits(usb::kSieCtrl, kPullUp);
  return true;
}

std::size_t UsbSerial::write(std::span<const std::uint8_t> bytes) {
  const std::size_t taken = put_bytes(out_, bytes);
  disable_interrupt(Interrupt::kUsb);
  send_data();
  if (in_armed_) {
    await_frame();  // nobody has fetched the packet: at least there are frames
  }
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

bool UsbSerial::on_interrupt() {
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
      packet_bytes_.reset();
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
  if ((status & usb::kOnFrame) != 0) {
    on_frame();
  }
  return (status & usb::kOnBuffer) != 0;
}

void UsbSerial::configure(bool on) {
  configured_ = on;
  stop_awaiting_frame();
  reg(usb::buffer_ctrl(usb::kDataEndpoint, Direction::kIn)) = 0;
  reg(usb::buffer_ctrl(usb::kDataEndpoint, Direction::kOut)) = 0;
  if (on) {
    usb::open_endpoint(usb::kNotifyEndpoint, Direction::kIn, usb::TransferType::kInterrupt,
                       usb::kNotifyBuffer);
    usb::open_endpoint(usb::kDataEndpoint, Direction::kIn, usb::TransferType::kBulk,
                       usb::kInBuffer);
    usb::open_endpoint(usb::kDataEndpoint, Direction::kOut, usb::TransferType::kBulk,
                       usb::kOutBuffer);
  }
  restart_data_in();
  restart_data_out();
}

void UsbSerial::restart_data_in() {
  reg(usb::buffer_ctrl(usb::kDataEndpoint, Direction::kIn)) = 0;
  in_data1_ = in_armed_ = false;  // a packet that nobody has fetched is sent anew
  send_data();
}

void UsbSerial::restart_data_out() {
  reg(usb::buffer_ctrl(usb::kDataEndpoint, Direction::kOut)) = 0;
  out_data1_ = out_armed_ = false;
  open_for_data();
}

/// Has the next packet ready and hands it to the controller, or has the next frame do so.
void UsbSerial::send_data() {
  if (!configured_ || in_armed_ || !prepare_packet()) {
    return;
  }
  // A bus error at a packet near its frame's end can hang the controller (RP2040-E15). The rest of
  // the frame is a margin for an interrupt that came late.
  constexpr std::uint32_t kUseOfAFrameUs = 600;
  if (now_us() - frame_began_us_ > kUseOfAFrameUs) {
    await_frame();
    return;
  }
  in_armed_ = true;
  usb::arm(usb::kDataEndpoint, Direction::kIn, *packet_bytes_, in_data1_);
  in_data1_ = !in_data1_;
}

/// Puts what waits into the controller's memory; false where nothing does. After a full packet that
/// was the last an empty one tells the host so: it would wait for more before it hands it on.
bool UsbSerial::prepare_packet() {
  if (!packet_bytes_) {
    std::array<std::uint8_t, kPacketBytes> packet{};
    const std::size_t length = take_bytes(out_, packet);
    if (length == 0 && !was_full_) {
      return false;
    }
    usb::copy_in(usb::kInBuffer, {packet.data(), length});
    was_full_ = length == kPacketBytes;
    packet_bytes_ = length;
  }
  return true;
}

void UsbSerial::await_frame() {
  if (!configured_ || awaits_frame_.load(std::memory_order_relaxed)) {
    return;
  }
  rp2040::read(usb::kFrameNumber);  // forgets the frames that have begun already
  frames_.note(timer_.now_us());
  awaits_frame_.store(true, std::memory_order_relaxed);
  reg(usb::kInterruptEnable) = kInterrupts | usb::kOnFrame;
}

void UsbSerial::stop_awaiting_frame() {
  awaits_frame_.store(false, std::memory_order_relaxed);
  reg(usb::kInterruptEnable) = kInterrupts;
}

/// While interrupts are off a frame is told late, nobody knows by how much: one is trusted that
/// comes a frame's length after another.
void UsbSerial::on_frame() {
  constexpr std::uint32_t kShortestFrameUs = 900;
  constexpr std::uint32_t kLongestFrameUs = 1100;
  rp2040::read(usb::kFrameNumber);  // ends the interrupt (4.1.4, SOF_RD)
  frames_.note(timer_.now_us());
  const std::uint32_t began_us = now_us();
  const std::uint32_t length_us = began_us - std::exchange(frame_told_us_, began_us);
  if (length_us < kShortestFrameUs || length_us > kLongestFrameUs) {
    return;
  }
  stop_awaiting_frame();
  frame_began_us_ = began_us;
  send_data();
}

bool UsbSerial::stuck() const {
  constexpr std::uint32_t kSuspended = 1U << 4U;
  return awaits_frame_.load(std::memory_order_relaxed) && frames_.overdue(timer_) &&
         (rp2040::read(usb::kSieStatus) & kSuspended) == 0;
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
