// SPDX-License-Identifier: Apache-2.0
// The STM32F4's ADC1: it converts both channels over and over, a burst is read from it (RM0090 13).
#pragma once

#include <cstdint>

#include "hal/concepts.hpp"
#include "hal/stm32f4/pins.hpp"
#include "hal/stm32f4/registers.hpp"
#include "hal/stm32f4/timer.hpp"

namespace penduline::stm32f4 {

/// Of a round the regular conversion is thrown away; the injected ones that follow it by themselves
/// have a register each, which holds the latest result. So no flag has to be waited for, which
/// QEMU's ADC would never raise, and no DMA is needed, which it has not.
class Adc {
 public:
  static constexpr std::uint16_t kTopCode = 4095;
  /// A round is 3 conversions of 28 + 12 cycles of 21 MHz, 5.7 us; a pair is read each 6 us, so
  /// that no conversion is read twice. (Should the PLL not have come up, some are.)
  static constexpr std::uint32_t kPairUs = 6;
  static constexpr std::uint32_t kConversionNs = kPairUs * 1000 / kChannels;

  explicit Adc(const Timer& timer) : timer_(timer) {}

  /// The pins PA0 and PA1 are the channels 0 and 1.
  void start(std::uint32_t apb2_hz) {
    constexpr std::uint32_t kDivideBy2 = 0;
    constexpr std::uint32_t kDivideBy4 = 1U << 16U;
    constexpr std::uint32_t kMostHzByTwo = 42'000'000;
    constexpr std::uint32_t kSample28CyclesEach = 2U | (2U << 3U);
    // The sequence of two stands in the last two of its four places (13.13.12).
    constexpr std::uint32_t kChannel0Then1 = (1U << 20U) | (0U << 10U) | (1U << 15U);
    constexpr std::uint32_t kScan = 1U << 8U;
    constexpr std::uint32_t kInjectedFollow = 1U << 10U;
    constexpr std::uint32_t kOnAndOver = (1U << 0U) | (1U << 1U);
    constexpr std::uint32_t kStart = 1U << 30U;
    set_bits(rcc::kApb2Enable, rcc::kAdc1);
    set_pin_mode(0, PinMode::kAnalogue);
    set_pin_mode(1, PinMode::kAnalogue);
    reg(adc::kCommonCtrl) = apb2_hz > kMostHzByTwo ? kDivideBy4 : kDivideBy2;
    reg(adc::kSampleTimeLow) = kSample28CyclesEach;
    reg(adc::kInjectedSequence) = kChannel0Then1;
    reg(adc::kCtrl1) = kScan | kInjectedFollow;
    reg(adc::kCtrl2) = kOnAndOver;
    const std::uint64_t on_us = timer_.now_us();
    wait_until(on_us + kPowerUpUs);
    reg(adc::kCtrl2) = kOnAndOver | kStart;
  }

  /// Reads a burst; takes 16 pairs of 6 us.
  bool convert(std::uint8_t first_channel, std::uint16_t* codes) {
    const std::uint32_t first = first_channel == 0 ? adc::kInjected1 : adc::kInjected2;
    const std::uint32_t second = first_channel == 0 ? adc::kInjected2 : adc::kInjected1;
    std::uint64_t at_us = timer_.now_us();
    for (std::size_t i = 0; i < kConversionsPerBurst; i += kChannels) {
      codes[i] = static_cast<std::uint16_t>(read(first));
      codes[i + 1] = static_cast<std::uint16_t>(read(second));
      at_us += kPairUs;
      wait_until(at_us);
    }
    return true;
  }

 private:
  static constexpr std::uint64_t kPowerUpUs = 3;

  void wait_until(std::uint64_t at_us) const {
    constexpr int kLooks = 1000;  // were the clock to stand still
    for (int look = 0; look < kLooks && timer_.now_us() < at_us; ++look) {
    }
  }

  const Timer& timer_;
};

static_assert(BurstConverter<Adc>);

}  // namespace penduline::stm32f4
