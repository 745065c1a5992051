// SPDX-License-Identifier: Apache-2.0
// A small CDC-ACM device that counts for its reader and sends back what it is sent; macros plant
// one mistake each.

#include "rp2040.hpp"
#include "usb_descriptors.hpp"

#ifdef MISTAKE
constexpr Mistake kMistake = Mistake::MISTAKE;
#else
constexpr Mistake kMistake = Mistake::none;
#endif
constexpr bool wrong(Mistake mistake) {
  return mistake == kMistake;
}

constexpr Word kDpram = 0x50100000, kUsb = 0x50110000;
constexpr Word kMainControl = kUsb + 0x40, kSieControl = kUsb + 0x4c, kSieStatus = kUsb + 0x50;
constexpr Word kBufferStatus = kUsb + 0x58, kStallArm = kUsb + 0x68, kMuxing = kUsb + 0x74,
               kPower = kUsb + 0x78;
constexpr Word kFrameNumber = kUsb + 0x48, kUsbEnables = kUsb + 0x90, kUsbStatus = kUsb + 0x98;
constexpr Word kEnables = 1u << 4 | 1u << 12 | 1u << 16, kOnFrame = 1u << 17;
constexpr Word kFull = 1u << 15, kData1 = 1u << 13, kStall = 1u << 11, kAvailable = 1u << 10;
constexpr Word kControlBuffer = 0x100, kInBuffer = 0x1c0, kOutBuffer = 0x200;

constexpr Word buffer_control(Word endpoint, bool in) {
  return kDpram + 0x80 + 8 * endpoint + (in ? 0 : 4);
}
constexpr Word endpoint_control(Word endpoint, bool in) {
  return kDpram + 8 * endpoint + (in ? 0 : 4);
}

struct Device {
  const std::uint8_t* reply;
  Word reply_left, control_toggle, in_toggle, out_toggle, new_address;
  bool replies, configured, takes_coding;
  std::uint8_t coding[8], counter;
};
static Device device;
extern "C" {
volatile Word baud, line_state;
}

static void arm(Word endpoint, bool in, Word value) {
  if (!wrong(Mistake::available_at_once))
    write(buffer_control(endpoint, in), value);
  asm volatile("nop\nnop\nnop\nnop\nnop\nnop\nnop\nnop\nnop\nnop\nnop\nnop");
  write(buffer_control(endpoint, in), value | kAvailable);
}

static void copy_in(Word buffer, const std::uint8_t* bytes, Word count) {
  auto* to = reinterpret_cast<volatile std::uint8_t*>(kDpram + buffer);
  for (Word i = 0; i < count; ++i)
    to[i] = bytes[i];
}

static void send_control(const std::uint8_t* bytes, Word count) {
  copy_in(kControlBuffer, bytes, count);
  arm(0, true,
      count | (wrong(Mistake::no_full) ? 0 : kFull) | (device.control_toggle ? kData1 : 0));
  device.control_toggle ^= 1;
}

static void acknowledge() {
  device.control_toggle = 1;
  send_control(device.coding, wrong(Mistake::long_status) ? 1 : 0);
}

static void refuse() {
  if (!wrong(Mistake::no_stall_arm))
    set_bits(kStallArm, 3);
  write(buffer_control(0, true), kStall);
  write(buffer_control(0, false), kStall);
}

static void reply_more() {
  const Word count = device.reply_left > 64 ? 64 : device.reply_left;
  send_control(device.reply, count);
  device.reply += count;
  device.reply_left -= count;
}

static void reply(Bytes bytes, Word wanted) {
  device.reply = bytes.data;
  device.reply_left = bytes.size > wanted && !wrong(Mistake::long_reply) ? wanted : bytes.size;
  device.replies = true;
  reply_more();
}

static void arm_out() {
  const Word length = wrong(Mistake::short_out) ? 8 : wrong(Mistake::overlong) ? 128 : 64;
  arm(2, false, length | (wrong(Mistake::full_out) ? kFull : 0) | (device.out_toggle ? kData1 : 0));
  device.out_toggle ^= 1;
}

static void send_count() {
  for (Word i = 0; i < 64; ++i)
    reinterpret_cast<volatile std::uint8_t*>(kDpram + kInBuffer)[i] = device.counter++;
  if (wrong(Mistake::stalled_bulk))
    return write(buffer_control(2, true), kStall);
  const bool data1 = device.in_toggle && !wrong(Mistake::no_toggle);
  arm(2, true, 64 | kFull | (data1 ? kData1 : 0));
  device.in_toggle ^= 1;
}

// Data goes out at the beginning of a frame only (RP2040-E15).
static void await_frame() {
  if (wrong(Mistake::late_in_frame))
    return send_count();
  read(kFrameNumber);
  write(kUsbEnables, kEnables | kOnFrame);
}

static void on_frame() {
  read(kFrameNumber);
  write(kUsbEnables, kEnables);
  if (device.configured)
    send_count();
}

static void configure() {
  const Word enable = wrong(Mistake::no_endpoint_enable) ? 1u << 29 : 1u << 31 | 1u << 29;
  const Word buffers = wrong(Mistake::double_buffer) ? enable | 1u << 30 : enable;
  write(endpoint_control(2, true),
        buffers | 2u << 26 | (wrong(Mistake::low_buffer) ? 0x140 : kInBuffer));
  write(endpoint_control(2, false), enable | 2u << 26 | kOutBuffer);
  device.in_toggle = device.out_toggle = 0;
  device.configured = true;
  arm_out();
  await_frame();
}

static void on_descriptor_request(Word kind, Word index, Word length) {
  if (kind == 1)
    return reply(kDeviceDescriptor, length);
  if (kind == 2)
    return reply(kConfigurationDescriptor, length);
  if (kind == 3 && index == 0)
    return reply(kLanguages, length);
  if (kind == 3 && index < 4 && !wrong(Mistake::no_strings))
    return reply(kName, length);
  refuse();
}

static void on_setup() {
  const auto* packet = reinterpret_cast<const volatile std::uint8_t*>(kDpram);
  const Word type = packet[0], code = packet[1], value = packet[2], high = packet[3],
             length = packet[6];
  device.control_toggle = 1;
  device.replies = device.takes_coding = false;
  device.new_address = 0;
  if (type == 0x80 && code == 6)
    return on_descriptor_request(high, value, length);
  if (type == 0 && code == 5) {
    device.new_address = value;
    if (wrong(Mistake::address_early))
      write(kUsb, value);
    return acknowledge();
  }
  if (type == 0 && code == 9 && !wrong(Mistake::no_configuration)) {
    configure();
    return acknowledge();
  }
  if (type == 0x21 && code == 0x20) {
    device.takes_coding = true;
    return arm(0, false, 64 | kData1);
  }
  if (type == 0xa1 && code == 0x21)
    return reply({device.coding, 7}, length);
  if (type == 0x21 && code == 0x22) {
    line_state = value;
    return acknowledge();
  }
  refuse();
}

static void on_control_sent() {
  if (device.new_address)
    write(kUsb, device.new_address);
  device.new_address = 0;
  if (!device.replies)
    return;
  if (device.reply_left)
    return reply_more();
  device.replies = false;
  arm(0, false, kData1);
}

static void on_control_received() {
  if (!device.takes_coding)
    return;
  device.takes_coding = false;
  const auto* from = reinterpret_cast<const volatile std::uint8_t*>(kDpram + kControlBuffer);
  for (Word i = 0; i < 7; ++i)
    device.coding[i] = from[i];
  baud = static_cast<Word>(device.coding[1] << 8 | device.coding[0]);
  acknowledge();
}

static void on_received() {
  const auto* from = reinterpret_cast<const volatile std::uint8_t*>(kDpram + kOutBuffer);
  device.counter = from[0];  // what is sent sets the count
  arm_out();
}

extern "C" void on_usb() {
  const Word status = read(kUsbStatus);
  if (status & 1u << 12) {
    write(kSieStatus, 1u << 19);
    write(kUsb, 0);
    device.configured = false;
  }
  if (status & 1u << 16) {
    write(kSieStatus, 1u << 17);
    on_setup();
  }
  if (status & kOnFrame)
    on_frame();
  if (!(status & 1u << 4))
    return;
  const Word buffers = read(kBufferStatus);
  write(kBufferStatus, buffers);
  if (buffers & 1u)
    on_control_sent();
  if (buffers & 2u)
    on_control_received();
  if (buffers & 1u << 4 && device.configured)
    await_frame();
  if (buffers & 1u << 5 && device.configured)
    on_received();
}

int main() {
  start_board();
  if (wrong(Mistake::no_clock))
    write(kClkUsbControl, 0);
  release(kUsbReset);
  for (Word word = 0; word < 0x1000; word += 4)
    write(kDpram + word, 0);
  write(kMuxing, 9);
  if (!wrong(Mistake::no_vbus))
    write(kPower, 0xc);
  if (!wrong(Mistake::no_controller))
    write(kMainControl, 1);
  write(kSieControl, 1u << 29);
  write(kUsbEnables, kEnables);
  enable_interrupt(5);
  if (!wrong(Mistake::no_pull_up))
    set_bits(kSieControl, 1u << 16);
  for (;;)
    sleep();
}
