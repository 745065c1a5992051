// SPDX-License-Identifier: Apache-2.0
// USART2 as a link, a Nucleo's ST-Link makes it a USB serial port (RM0090 30).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "hal/concepts.hpp"
#include "hal/interrupt_ring.hpp"
#include "hal/progress_watch.hpp"
#include "hal/stm32f4/interrupts.hpp"
#include "hal/stm32f4/pins.hpp"
#include "hal/stm32f4/registers.hpp"
#include "hal/stm32f4/timer.hpp"

namespace penduline::stm32f4 {

/// 460,800 baud, 8 data bits, no parity, one stop bit, on PA2 (out) and PA3 (in).
class Uart {
 public:
  static constexpr std::size_t kWaitingBytes = 2048;
  static constexpr std::uint32_t kBaud = 460'800;

  explicit Uart(const Timer& timer) : timer_(timer) {}

  void start(std::uint32_t apb1_hz) {
    constexpr std::uint32_t kUsartFunction = 7;
    constexpr std::uint32_t kOutPin = 2;
    constexpr std::uint32_t kInPin = 3;
    set_bits(rcc::kApb1Enable, rcc::kUsart2);
    pull_up(kInPin);
    connect_pin(kOutPin, kUsartFunction);
    connect_pin(kInPin, kUsartFunction);
    reg(usart2::kBaud) = (apb1_hz + kBaud / 2) / kBaud;  // in sixteenths; 0.2 % off at 42 MHz
    reg(usart2::kCtrl1) = kOnBothWays;
  }

  std::size_t write(std::span<const std::uint8_t> bytes) {
    const std::size_t taken = put_bytes(out_, bytes);
    // With its interrupt off, which empties the ring as well: the bytes keep their order.
    disable_usart_2();
    send(stm32f4::read(usart2::kStatus));
    enable_usart_2();
    return taken;
  }

  std::size_t read(std::span<std::uint8_t> bytes) { return take_bytes(in_, bytes); }

  /// Its transmitter needs nobody at the other end: a second without a byte out is a fault.
  [[nodiscard]] bool stuck() const { return !out_.empty() && sent_.overdue(timer_); }
  [[nodiscard]] bool asks_for_bootloader() const { return false; }

  /// One byte each way at most; while there is more to do the interrupt comes again.
  void on_interrupt() {
    const std::uint32_t status = stm32f4::read(usart2::kStatus);
    if ((status & (kReceived | kOverrun)) != 0) {
      // Reading the byte ends both conditions; after an overrun the byte is still the first one.
      const auto byte = static_cast<std::uint8_t>(stm32f4::read(usart2::kData));
      std::uint8_t* slot = in_.free_slot();
      if ((status & kReceived) != 0 && slot != nullptr) {
        *slot = byte;
        in_.put();
      }
    }
    send(status);
  }

 private:
  static constexpr std::uint32_t kOverrun = 1U << 3U;           ///< of the status
  static constexpr std::uint32_t kReceived = 1U << 5U;          ///< of the status
  static constexpr std::uint32_t kTransmitterEmpty = 1U << 7U;  ///< of the status
  static constexpr std::uint32_t kInterruptWhenEmpty = 1U << 7U;
  static constexpr std::uint32_t kOnBothWays =
      (1U << 13U) | (1U << 3U) | (1U << 2U) | (1U << 5U);  ///< with interrupts for what comes

  void send(std::uint32_t status) {
    while ((status & kTransmitterEmpty) != 0) {
      const std::uint8_t* slot = out_.full_slot();
      if (slot == nullptr) {
        break;
      }
      reg(usart2::kData) = *slot;
      out_.drop();
      sent_.note(timer_.now_us());
      status = stm32f4::read(usart2::kStatus);
    }
    reg(usart2::kCtrl1) = kOnBothWays | (out_.empty() ? 0 : kInterruptWhenEmpty);
  }

  const Timer& timer_;
  InterruptRing<std::uint8_t, 256> out_;
  InterruptRing<std::uint8_t, 256> in_;
  ProgressWatch sent_;
};

static_assert(ByteLink<Uart>);

}  // namespace penduline::stm32f4
