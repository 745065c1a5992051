// SPDX-License-Identifier: Apache-2.0
// libusb on a board's serial port, past the kernel's driver: what Penduline relies on as source
// `usb:`.
#include <libusb.h>

#include <array>
#include <catch2/catch.hpp>
#include <cstdint>
#include <cstring>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "common/wire/decoder.hpp"
#include "common/wire/device_messages.hpp"
#include "common/wire/frame.hpp"
#include "tests/kernel/libraries/gadget.hpp"

namespace penduline::test {
namespace {

constexpr int kControlInterface = 0;
constexpr int kDataInterface = 1;
constexpr int kPacketBytes = 512;  // of a high-speed bulk endpoint
constexpr unsigned kPatienceMs = 2000;

struct Closer {
  void operator()(libusb_context* context) const { libusb_exit(context); }
  void operator()(libusb_device_handle* handle) const { libusb_close(handle); }
  void operator()(libusb_transfer* transfer) const { libusb_free_transfer(transfer); }
};
template <class Resource>
using Owned = std::unique_ptr<Resource, Closer>;

Owned<libusb_context> start_libusb() {
  libusb_context* context = nullptr;
  REQUIRE(libusb_init(&context) == LIBUSB_SUCCESS);
  return Owned<libusb_context>(context);
}

Owned<libusb_device_handle> open_board(const Owned<libusb_context>& context) {
  Owned<libusb_device_handle> board(
      libusb_open_device_with_vid_pid(context.get(), kVendor, kProduct));
  REQUIRE(board);
  return board;
}

/// A board's port, taken from the kernel's driver.
struct Port {
  Owned<libusb_device_handle> board;
  std::uint8_t in = 0;
  std::uint8_t out = 0;
};

Port claim_port(const Owned<libusb_context>& context) {
  Port port{.board = open_board(context)};
  libusb_device_handle* const board = port.board.get();
  libusb_config_descriptor* configuration = nullptr;
  REQUIRE(libusb_get_active_config_descriptor(libusb_get_device(board), &configuration) ==
          LIBUSB_SUCCESS);
  const libusb_interface_descriptor& data = configuration->interface[kDataInterface].altsetting[0];
  for (int i = 0; i < data.bNumEndpoints; ++i) {
    const std::uint8_t address = data.endpoint[i].bEndpointAddress;
    CHECK(data.endpoint[i].wMaxPacketSize == kPacketBytes);
    ((address & LIBUSB_ENDPOINT_IN) != 0 ? port.in : port.out) = address;
  }
  libusb_free_config_descriptor(configuration);
  REQUIRE(libusb_detach_kernel_driver(board, kControlInterface) == LIBUSB_SUCCESS);
  REQUIRE(libusb_claim_interface(board, kDataInterface) == LIBUSB_SUCCESS);
  return port;
}

/// What one transfer came to.
struct Transfer {
  int result;
  std::vector<std::uint8_t> bytes;
};

Transfer read_once(const Port& port, std::size_t room, unsigned patience_ms = kPatienceMs) {
  std::vector<std::uint8_t> bytes(room);
  int got = 0;
  const int result = libusb_bulk_transfer(port.board.get(), port.in, bytes.data(),
                                          static_cast<int>(room), &got, patience_ms);
  bytes.resize(static_cast<std::size_t>(got));
  return {result, bytes};
}

/// Frames of samples `first` to `last`.
std::vector<std::uint8_t> sample_frames(std::uint64_t first, std::uint64_t last) {
  std::vector<std::uint8_t> frames;
  for (std::uint64_t seq = first; seq <= last; ++seq) {
    std::array<std::uint8_t, wire::kFrameBytes<wire::SampleMessage>> frame{};
    REQUIRE(wire::encode_frame(wire::SampleMessage{.seq = seq}, frame) == frame.size());
    frames.insert(frames.end(), frame.begin(), frame.end());
  }
  return frames;
}

TEST_CASE("A board is found by its identity and its serial number", "[usb]") {
  const Gadget gadget;
  const auto context = start_libusb();
  const auto board = open_board(context);
  libusb_device_descriptor device{};
  REQUIRE(libusb_get_device_descriptor(libusb_get_device(board.get()), &device) == LIBUSB_SUCCESS);
  const auto text = [&](std::uint8_t index) {
    std::array<unsigned char, 64> characters{};
    const int size = libusb_get_string_descriptor_ascii(board.get(), index, characters.data(),
                                                        static_cast<int>(characters.size()));
    return std::string(characters.begin(), characters.begin() + std::max(size, 0));
  };
  CHECK(text(device.iProduct) == "Penduline");
  CHECK(text(device.iSerialNumber) == kSerialNumber);
}

TEST_CASE("The kernel's driver gives the port up and takes it back", "[usb]") {
  const Gadget gadget;
  const auto context = start_libusb();
  const auto board = open_board(context);
  CHECK(libusb_claim_interface(board.get(), kDataInterface) == LIBUSB_ERROR_BUSY);

  REQUIRE(libusb_detach_kernel_driver(board.get(), kControlInterface) == LIBUSB_SUCCESS);
  CHECK(comes_true([] { return !port_exists(); }));
  // Both interfaces are one driver's.
  CHECK(libusb_kernel_driver_active(board.get(), kDataInterface) == 0);
  CHECK(libusb_claim_interface(board.get(), kDataInterface) == LIBUSB_SUCCESS);

  REQUIRE(libusb_release_interface(board.get(), kDataInterface) == LIBUSB_SUCCESS);
  REQUIRE(libusb_attach_kernel_driver(board.get(), kControlInterface) == LIBUSB_SUCCESS);
  CHECK(comes_true(port_exists));
}

TEST_CASE("Bulk transfers carry the board's frames in order and whole", "[usb]") {
  constexpr std::uint64_t kSamples = 100;
  const Gadget gadget;
  const auto context = start_libusb();
  const Port port = claim_port(context);
  gadget.send(sample_frames(0, kSamples - 1));
  wire::Decoder decoder;
  std::uint64_t next = 0;
  while (next < kSamples) {
    const Transfer transfer = read_once(port, 4096);
    REQUIRE(transfer.result == LIBUSB_SUCCESS);
    decoder.push(transfer.bytes, [&](const wire::Frame& frame) {
      const auto sample = wire::read_message<wire::SampleMessage>(frame.payload);
      REQUIRE(sample);
      CHECK(sample->seq == next++);
    });
  }
  CHECK(decoder.bad_frames() == 0);
}

TEST_CASE("What the host sends reaches the board", "[usb]") {
  const Gadget gadget;
  const auto context = start_libusb();
  const Port port = claim_port(context);
  std::string question = "question";
  int sent = 0;
  CHECK(libusb_bulk_transfer(
            port.board.get(), port.out, reinterpret_cast<unsigned char*>(question.data()),
            static_cast<int>(question.size()), &sent, kPatienceMs) == LIBUSB_SUCCESS);
  CHECK(gadget.receive() == question);
}

TEST_CASE("Whole packets are ended by an empty one, which is not the end of the stream", "[usb]") {
  const Gadget gadget;
  const auto context = start_libusb();
  const Port port = claim_port(context);
  const auto frames = sample_frames(0, kPacketBytes / 32 - 1);
  REQUIRE(frames.size() == kPacketBytes);

  gadget.send(frames);
  CHECK(read_once(port, kPacketBytes).bytes == frames);
  const Transfer empty = read_once(port, kPacketBytes);
  CHECK(empty.result == LIBUSB_SUCCESS);
  CHECK(empty.bytes.empty());

  CHECK(read_once(port, kPacketBytes, 50).result == LIBUSB_ERROR_TIMEOUT);
  gadget.send(frames);
  CHECK(read_once(port, kPacketBytes).bytes == frames);
}

TEST_CASE("Pulling the cable ends a transfer that waits, and all that come after", "[usb]") {
  Gadget gadget;
  const auto context = start_libusb();
  const Port port = claim_port(context);
  std::array<unsigned char, kPacketBytes> bytes{};
  const Owned<libusb_transfer> transfer(libusb_alloc_transfer(0));
  int ended = 0;
  libusb_fill_bulk_transfer(
      transfer.get(), port.board.get(), port.in, bytes.data(), static_cast<int>(bytes.size()),
      [](libusb_transfer* done) { *static_cast<int*>(done->user_data) = 1; }, &ended, 0);
  REQUIRE(libusb_submit_transfer(transfer.get()) == LIBUSB_SUCCESS);

  gadget.unplug();
  REQUIRE(comes_true([&] {
    timeval at_once{};
    libusb_handle_events_timeout_completed(context.get(), &at_once, &ended);
    return ended != 0;
  }));
  // Which of the two is a race within the kernel.
  const bool known =
      transfer->status == LIBUSB_TRANSFER_NO_DEVICE || transfer->status == LIBUSB_TRANSFER_ERROR;
  CHECK(known);
  CHECK(comes_true([&] { return read_once(port, kPacketBytes).result == LIBUSB_ERROR_NO_DEVICE; }));
}

TEST_CASE("Plugging and unplugging are told as they happen", "[usb]") {
  const auto context = start_libusb();
  REQUIRE(libusb_has_capability(LIBUSB_CAP_HAS_HOTPLUG) != 0);
  std::vector<libusb_hotplug_event> told;
  REQUIRE(libusb_hotplug_register_callback(
              context.get(), LIBUSB_HOTPLUG_EVENT_DEVICE_ARRIVED | LIBUSB_HOTPLUG_EVENT_DEVICE_LEFT,
              LIBUSB_HOTPLUG_NO_FLAGS, kVendor, kProduct, LIBUSB_HOTPLUG_MATCH_ANY,
              [](libusb_context*, libusb_device*, libusb_hotplug_event event, void* list) {
                static_cast<std::vector<libusb_hotplug_event>*>(list)->push_back(event);
                return 0;
              },
              &told, nullptr) == LIBUSB_SUCCESS);
  const auto is_told = [&](std::size_t count) {
    return comes_true([&] {
      timeval at_once{};
      libusb_handle_events_timeout_completed(context.get(), &at_once, nullptr);
      return told.size() >= count;
    });
  };
  Gadget gadget;
  CHECK(is_told(1));
  gadget.unplug();
  CHECK(is_told(2));
  CHECK(told == std::vector{LIBUSB_HOTPLUG_EVENT_DEVICE_ARRIVED, LIBUSB_HOTPLUG_EVENT_DEVICE_LEFT});
}

}  // namespace
}  // namespace penduline::test
