// SPDX-License-Identifier: Apache-2.0
// UART0 as a link: what is written waits in a ring for the transmitter (data sheet 4.2).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "hal/concepts.hpp"
#include "hal/interrupt_ring.hpp"
#include "hal/progress_watch.hpp"
#include "hal/rp2040/pins.hpp"
#include "hal/rp2040/registers.hpp"
#include "hal/rp2040/timer.hpp"

namespace penduline::rp2040 {

/// 460,800 baud, 8 data bits, no parity, one stop bit, on GPIO0 (out) and GPIO1 (in).
class Uart {
 public:
  static constexpr std::size_t kWaitingBytes = 1024;
  explicit Uart(const Timer& timer) : timer_(timer) {}

  [[nodiscard]] bool start() {
    constexpr std::uint32_t kEightBitsWithFifo = (3U << 5U) | (1U << 4U);
    constexpr std::uint32_t kOnBothWays = (1U << 0U) | (1U << 8U) | (1U << 9U);
    constexpr std::uint32_t kOutPin = 0;
    constexpr std::uint32_t kInPin = 1;
    if (!restart_peripheral(resets::kUart0)) {
      return false;
    }
    // 125 MHz / (16 * 460800) = 16 + 61/64; the line control must be written after them (4.2.7.1).
    reg(uart::kBaudInteger) = 16;
    reg(uart::kBaudFraction) = 61;
    reg(uart::kLineCtrl) = kEightBitsWithFifo;
    reg(uart::kCtrl) = kOnBothWays;
    connect_pin(kOutPin, gpio::kFunctionUart);
    connect_pin(kInPin, gpio::kFunctionUart);
    pull_up(kInPin);
    reg(uart::kInterruptMask) = kReceived | kReceiveTimeout;
    return true;
  }

  std::size_t write(std::span<const std::uint8_t> bytes) {
    const std::size_t taken = put_bytes(out_, bytes);
    // With its interrupt off, which empties the ring as well: the bytes keep their order.
    disable_interrupt(Interrupt::kUart0);
    send();
    enable_interrupt(Interrupt::kUart0);
    return taken;
  }

  std::size_t read(std::span<std::uint8_t> bytes) { return take_bytes(in_, bytes); }

  /// Its transmitter needs nobody at the other end: a second without a byte out is a fault.
  [[nodiscard]] bool stuck() const { return !out_.empty() && sent_.overdue(timer_); }
  [[nodiscard]] bool asks_for_bootloader() const { return false; }

  /// True where bytes have come or there is room for others to go.
  bool on_interrupt() {
    reg(uart::kInterruptClear) = kReceived | kReceiveTimeout | kSent;
    while ((rp2040::read(uart::kFlags) & kNothingReceived) == 0) {
      const auto byte = static_cast<std::uint8_t>(rp2040::read(uart::kData));
      if (std::uint8_t* slot = in_.free_slot()) {
        *slot = byte;
        in_.put();
      }
    }
    send();
    return !in_.empty() || out_.empty();
  }

 private:
  static constexpr std::uint32_t kReceived = 1U << 4U;
  static constexpr std::uint32_t kSent = 1U << 5U;
  static constexpr std::uint32_t kReceiveTimeout = 1U << 6U;
  static constexpr std::uint32_t kNothingReceived = 1U << 4U;
  static constexpr std::uint32_t kTransmitterFull = 1U << 5U;

  void send() {
    while ((rp2040::read(uart::kFlags) & kTransmitterFull) == 0) {
      const std::uint8_t* slot = out_.full_slot();
      if (slot == nullptr) {
        break;
      }
      reg(uart::kData) = *slot;
      out_.drop();
      sent_.note(timer_.now_us());
    }
    reg(uart::kInterruptMask) = kReceived | kReceiveTimeout | (out_.empty() ? 0 : kSent);
  }

  const Timer& timer_;
  InterruptRing<std::uint8_t, 128> out_;
  InterruptRing<std::uint8_t, 128> in_;
  ProgressWatch sent_;
};

static_assert(ByteLink<Uart>);

}  // namespace penduline::rp2040
