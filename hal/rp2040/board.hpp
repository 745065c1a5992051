// SPDX-License-Identifier: Apache-2.0
// The Raspberry Pi Pico as a board of Penduline.
#pragma once

#include <cstdint>
#include <string_view>
#include <tuple>

#include "hal/concepts.hpp"
#include "hal/rp2040/adc.hpp"
#include "hal/rp2040/flash.hpp"
#include "hal/rp2040/pins.hpp"
#include "hal/rp2040/reset.hpp"
#include "hal/rp2040/sampler.hpp"
#include "hal/rp2040/timer.hpp"
#include "hal/rp2040/uart.hpp"
#include "hal/rp2040/usb_serial.hpp"

namespace penduline::rp2040 {

/// There is one, `pico()`.
class Board {
 public:
  static constexpr std::string_view kName = "pico";
  static constexpr std::uint32_t kReferenceUv = 3'300'000;
  static constexpr std::uint32_t kEmitterPin = 15;  ///< drives both emitters' transistors
  static constexpr std::uint32_t kLightPin = 25;    ///< the LED on the Pico

  using Emitters = LightPin<kEmitterPin>;

  /// Brings clocks and peripherals up; restarts the board where one does not come.
  void start();

  [[nodiscard]] Timer& clock() { return timer_; }
  [[nodiscard]] Sampler<Emitters>& sampler() { return sampler_; }
  [[nodiscard]] std::tuple<UsbSerial&, Uart&> links() { return {usb_, uart_}; }
  [[nodiscard]] HardwareWatchdog& watchdog() { return watchdog_; }
  [[nodiscard]] LightPin<kLightPin>& indicator() { return light_; }
  [[nodiscard]] ResetControl& resets() { return resets_; }
  [[nodiscard]] FlashId& id() { return id_; }
  [[nodiscard]] FlashStore& store() { return store_; }
  [[nodiscard]] CrashRecord& crash_record();
  [[nodiscard]] std::uint32_t stack_free_bytes() const;
  [[nodiscard]] std::int16_t temperature_cdeg() const;
  void sleep();

  // For the interrupts.
  [[nodiscard]] UsbSerial& usb() { return usb_; }
  [[nodiscard]] Uart& uart() { return uart_; }
  /// There is something for the main loop.
  void wake() { work_ = true; }

 private:
  Timer timer_;
  Adc adc_;
  Emitters emitters_;
  Sampler<Emitters> sampler_{timer_, adc_, emitters_};
  UsbSerial usb_{timer_};
  Uart uart_{timer_};
  LightPin<kLightPin> light_;
  HardwareWatchdog watchdog_;
  ResetControl resets_;
  FlashStore store_;
  FlashId id_;
  volatile bool work_ = false;
};

static_assert(FirmwareBoard<Board>);

[[nodiscard]] Board& pico();

}  // namespace penduline::rp2040
