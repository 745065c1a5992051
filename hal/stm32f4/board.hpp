// SPDX-License-Identifier: Apache-2.0
// The Nucleo-F446RE as a board of Penduline; F405 boards with the same pins run the same image.
#pragma once

#include <cstdint>
#include <string_view>
#include <tuple>

#include "common/wire/device_messages.hpp"
#include "hal/concepts.hpp"
#include "hal/stm32f4/adc.hpp"
#include "hal/stm32f4/flash.hpp"
#include "hal/stm32f4/pins.hpp"
#include "hal/stm32f4/reset.hpp"
#include "hal/stm32f4/sampler.hpp"
#include "hal/stm32f4/timer.hpp"
#include "hal/stm32f4/uart.hpp"

namespace penduline::stm32f4 {

/// There is one, `nucleo()`.
class Board {
 public:
  static constexpr std::string_view kName = "nucleo";
  static constexpr std::uint32_t kReferenceUv = 3'300'000;
  static constexpr std::uint32_t kEmitterPin = 8;  ///< PA8 drives both emitters' transistors
  static constexpr std::uint32_t kLightPin = 5;    ///< PA5 is LD2 on the Nucleo

  using Emitters = LightPin<kEmitterPin>;

  /// Brings clocks and peripherals up.
  void start();

  [[nodiscard]] Timer& clock() { return timer_; }
  [[nodiscard]] Sampler<Emitters>& sampler() { return sampler_; }
  [[nodiscard]] std::tuple<Uart&> links() { return {uart_}; }
  [[nodiscard]] HardwareWatchdog& watchdog() { return watchdog_; }
  [[nodiscard]] LightPin<kLightPin>& indicator() { return light_; }
  [[nodiscard]] ResetControl& resets() { return resets_; }
  [[nodiscard]] ChipId& id() { return id_; }
  [[nodiscard]] FlashStore& store() { return store_; }
  [[nodiscard]] CrashRecord& crash_record();
  [[nodiscard]] std::uint32_t stack_free_bytes() const;
  /// The thermometer's channel would have to be converted for ten times as long as the others.
  [[nodiscard]] std::int16_t temperature_cdeg() const { return wire::kUnknownTemperature; }
  void sleep();

  // For the interrupts.
  [[nodiscard]] Uart& uart() { return uart_; }
  void note_interrupt() { interrupted_ = true; }

 private:
  Timer timer_;
  Adc adc_{timer_};
  Emitters emitters_;
  Sampler<Emitters> sampler_{timer_, adc_, emitters_};
  Uart uart_{timer_};
  LightPin<kLightPin> light_;
  HardwareWatchdog watchdog_;
  ResetControl resets_;
  FlashStore store_{timer_};
  ChipId id_;
  volatile bool interrupted_ = false;
};

static_assert(FirmwareBoard<Board>);

[[nodiscard]] Board& nucleo();

}  // namespace penduline::stm32f4
