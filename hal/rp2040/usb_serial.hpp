// SPDX-License-Identifier: Apache-2.0
// The board as a USB serial port (CDC-ACM).
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "hal/concepts.hpp"
#include "hal/interrupt_ring.hpp"
#include "hal/progress_watch.hpp"
#include "hal/rp2040/timer.hpp"
#include "hal/rp2040/usb_descriptors.hpp"

namespace penduline::rp2040 {

/// A USB serial port. What DTR says is noted for the bootloader's touch only: data flows whenever
/// the host reads.
class UsbSerial {
 public:
  /// `serial_number` is hexadecimal text, one character for each half byte of the unique id.
  using SerialNumber = std::array<char, 2 * kUniqueIdBytes>;

  static constexpr std::size_t kWaitingBytes = 2048;

  explicit UsbSerial(const Timer& timer) : timer_(timer) {}

  [[nodiscard]] bool start(const std::array<std::uint8_t, kUniqueIdBytes>& unique_id);

  std::size_t write(std::span<const std::uint8_t> bytes);
  std::size_t read(std::span<std::uint8_t> bytes);
  /// A host that does not read is no fault; a bus that is neither suspended nor has frames is one.
  [[nodiscard]] bool stuck() const;
  /// The touch: the host set 1200 baud and let DTR go.
  [[nodiscard]] bool asks_for_bootloader() const {
    return touched_.load(std::memory_order_relaxed);
  }

  /// True where bytes may have come or there is room for others to go.
  bool on_interrupt();

 private:
  /// The stages of a control transfer (USB 2.0, 8.5.3).
  enum class Stage : std::uint8_t { kIdle, kDataIn, kDataOut, kStatusIn, kStatusOut };

  struct Setup {
    std::uint8_t type;
    std::uint8_t request;
    std::uint16_t value;
    std::uint16_t index;
    std::uint16_t length;
  };

  void on_setup();
  void on_standard_request(const Setup& setup);
  void on_class_request(const Setup& setup);
  void on_control_in();
  void on_control_out();
  void give_descriptor(const Setup& setup);
  void give_string(const Setup& setup);
  void give(std::span<const std::uint8_t> reply, const Setup& setup);
  void give_next();
  void acknowledge();
  void configure(bool on);
  void restart_data_in();
  void restart_data_out();
  void send_data();
  [[nodiscard]] bool prepare_packet();
  void await_frame();
  void stop_awaiting_frame();
  void on_frame();
  void take_data();
  void open_for_data();
  /// The clock's low word.
  [[nodiscard]] std::uint32_t now_us() const { return static_cast<std::uint32_t>(timer_.now_us()); }

  const Timer& timer_;
  std::array<std::uint8_t, 64> reply_{};  ///< what is made up for the request
  std::span<const std::uint8_t> to_give_{};
  bool empty_packet_last_ = false;
  Stage stage_ = Stage::kIdle;
  bool control_data1_ = false;
  std::uint8_t new_address_ = 0;
  bool configured_ = false;
  bool in_data1_ = false;
  bool out_data1_ = false;
  bool in_armed_ = false;
  bool out_armed_ = false;
  std::optional<std::size_t> packet_bytes_;  ///< of the one that is ready to go
  bool was_full_ = false;                    ///< the packet before it
  std::uint32_t frame_began_us_ = 0;
  std::uint32_t frame_told_us_ = 0;  ///< the newest that an interrupt told of
  std::atomic<bool> awaits_frame_{false};
  ProgressWatch frames_;
  std::array<std::uint8_t, 7> line_coding_ = {0x00, 0xc2, 0x01, 0x00, 0, 0, 8};  ///< 115200 8N1
  SerialNumber serial_number_{};
  std::atomic<bool> touched_{false};
  InterruptRing<std::uint8_t, 256> out_;
  InterruptRing<std::uint8_t, 256> in_;
};

static_assert(ByteLink<UsbSerial>);

}  // namespace penduline::rp2040
