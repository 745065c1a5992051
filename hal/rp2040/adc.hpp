// SPDX-License-Identifier: Apache-2.0
// The RP2040's ADC: bursts in turn on two channels, carried to memory by DMA (data sheet 4.9, 2.5).
#pragma once

#include <cstdint>

#include "hal/concepts.hpp"
#include "hal/rp2040/pins.hpp"
#include "hal/rp2040/registers.hpp"

namespace penduline::rp2040 {

class Adc {
 public:
  static constexpr std::uint16_t kTopCode = 4095;
  static constexpr std::uint32_t kConversionNs = 2000;  ///< 96 cycles of 48 MHz

  /// Pins GPIO26 and GPIO27 are the channels 0 and 1.
  [[nodiscard]] bool start() {
    constexpr std::uint32_t kFirstPin = 26;
    if (!restart_peripheral(resets::kAdc) || !restart_peripheral(resets::kDma)) {
      return false;
    }
    for (std::uint32_t channel = 0; channel < kChannels; ++channel) {
      make_analogue(kFirstPin + channel);
    }
    reg(adc::kCs) = adc::kEnable | adc::kTemperatureOn;
    reg(dma::kInterruptEnable0) = 1;
    return wait_for(adc::kCs, adc::kReady);
  }

  /// Begins a burst; the DMA's interrupt tells its end.
  bool convert(std::uint8_t first_channel, std::uint16_t* codes) {
    constexpr std::uint32_t kBothInTurn = 3U << 16U;
    constexpr std::uint32_t kFifoOnAtOne = (1U << 0U) | (1U << 3U) | (1U << 24U);
    constexpr std::uint32_t kClearErrors = (1U << 10U) | (1U << 11U);
    constexpr std::uint32_t kDmaEnable = 1U << 0U;
    constexpr std::uint32_t kHalfWords = 1U << 2U;
    constexpr std::uint32_t kNextAddressWritten = 1U << 5U;
    come_to_rest();
    reg(adc::kFifoCs) = kFifoOnAtOne | kClearErrors;
    reg(dma::kReadAddress) = adc::kFifo;
    reg(dma::kWriteAddress) = static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(codes));
    reg(dma::kCount) = kConversionsPerBurst;
    reg(dma::kCtrlTrigger) = kDmaEnable | kHalfWords | kNextAddressWritten | (dma::kDreqAdc << 15U);
    reg(adc::kCs) = adc::kEnable | adc::kTemperatureOn | kBothInTurn |
                    (std::uint32_t{first_channel} << 12U) | adc::kStartMany;
    return false;
  }

  /// To be called when the DMA has carried a burst over: stops converting.
  void finish_burst() {
    reg(dma::kInterruptStatus0) = 1;
    clear_bits(adc::kCs, adc::kStartMany);
    asm volatile("" ::: "memory");  // what the DMA wrote is read after this
  }

  /// Starts one conversion of the chip's own temperature, to be read before the next window.
  void start_temperature() {
    constexpr std::uint32_t kTemperatureChannel = 4U << 12U;
    come_to_rest();
    reg(adc::kCs) = adc::kEnable | adc::kTemperatureOn | kTemperatureChannel | adc::kStartOne;
  }
  [[nodiscard]] std::uint16_t last_code() const {
    return static_cast<std::uint16_t>(read(adc::kResult));
  }

 private:
  /// Lets the conversion that is running end and forgets what stands in the FIFO.
  void come_to_rest() {
    constexpr std::uint32_t kLooksOfAConversion = 100;
    constexpr std::uint32_t kFifoSlots = 8;
    constexpr std::uint32_t kFifoEmpty = 1U << 8U;
    // A conversion always ends; were it not to, the next burst would show it.
    static_cast<void>(wait_for(adc::kCs, adc::kReady, kLooksOfAConversion));
    for (std::uint32_t i = 0; i < kFifoSlots && (read(adc::kFifoCs) & kFifoEmpty) == 0; ++i) {
      read(adc::kFifo);
    }
  }
};

static_assert(BurstConverter<Adc>);

}  // namespace penduline::rp2040
