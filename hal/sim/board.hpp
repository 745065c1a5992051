// SPDX-License-Identifier: Apache-2.0
// A board of Penduline in virtual time: the firmware as a Linux process.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <tuple>

#include "common/wire/device_messages.hpp"
#include "hal/concepts.hpp"
#include "hal/sim/file_link.hpp"
#include "hal/sim/flash_file.hpp"
#include "hal/sim/simulated_rig.hpp"
#include "hal/sim/virtual_adc.hpp"
#include "hal/sim/virtual_clock.hpp"
#include "hal/sim/virtual_reset.hpp"
#include "hal/sim/virtual_sampler.hpp"

namespace penduline::sim {

/// What a reset leaves as it is. One of them lives through the lives of many boards.
template <ByteLink Link>
struct Surroundings {
  SimulatedRig rig;
  Link link;
  FlashFile flash{};
  CrashRecord kept{};  ///< memory that is never initialised; its boot_id may be chosen
  wire::ResetCause last_reset = wire::ResetCause::kPowerOn;
  std::uint64_t since_us = 0;  ///< from the rig's start to the board's last reset
  std::uint64_t serial_number = 0;
  /// How often the board wakes without an alarm, to look what has come on its link.
  std::uint64_t tick_us = 1000;
};

/// The flash as the firmware sees it: while it is written interrupts wait.
class SlowFlash {
 public:
  static constexpr std::uint64_t kWriteUs = 50'000;

  SlowFlash(FlashFile& flash, VirtualClock& clock) : flash_(flash), clock_(clock) {}

  [[nodiscard]] std::span<const std::uint8_t> contents() const { return flash_.contents(); }
  bool replace(std::span<const std::uint8_t> block) {
    clock_.pass_us(kWriteUs);
    return flash_.replace(block);
  }

 private:
  FlashFile& flash_;
  VirtualClock& clock_;
};

static_assert(Store<SlowFlash>);

/// The serial number as the chip's own, most significant byte first.
class SerialNumber {
 public:
  explicit SerialNumber(std::uint64_t number) : number_(number) {}

  [[nodiscard]] std::array<std::uint8_t, kUniqueIdBytes> unique_id() const {
    std::array<std::uint8_t, kUniqueIdBytes> bytes{};
    for (std::size_t i = 0; i < bytes.size(); ++i) {
      bytes[i] = static_cast<std::uint8_t>(number_ >> (8 * (bytes.size() - 1 - i)));
    }
    return bytes;
  }

 private:
  std::uint64_t number_;
};

static_assert(UniqueId<SerialNumber>);

/// From power-on or a reset until `resets().ending()`. Its main loop takes no time at all; time
/// passes in `sleep`. The rig needs two sensors.
template <ByteLink Link>
class Board {
 public:
  static constexpr std::string_view kName = "sim";
  static constexpr std::uint32_t kReferenceUv = 3'300'000;

  explicit Board(Surroundings<Link>& surroundings)
      : surroundings_(surroundings),
        adc_(clock_, emitters_, surroundings.rig, kReferenceUv / 1e6),
        sampler_(clock_, adc_, emitters_, surroundings.rig, surroundings.since_us),
        resets_(surroundings.last_reset),
        flash_(surroundings.flash, clock_),
        id_(surroundings.serial_number) {
    clock_.set_alarm(Alarm::kTick, surroundings_.tick_us);
  }
  Board(const Board&) = delete;
  Board& operator=(const Board&) = delete;
  ~Board() = default;

  [[nodiscard]] VirtualClock& clock() { return clock_; }
  [[nodiscard]] Sampler& sampler() { return sampler_; }
  [[nodiscard]] std::tuple<Link&> links() { return {surroundings_.link}; }
  [[nodiscard]] VirtualWatchdog& watchdog() { return watchdog_; }
  [[nodiscard]] Light& indicator() { return light_; }
  [[nodiscard]] VirtualReset& resets() { return resets_; }
  [[nodiscard]] SerialNumber& id() { return id_; }
  [[nodiscard]] SlowFlash& store() { return flash_; }
  [[nodiscard]] CrashRecord& crash_record() { return surroundings_.kept; }
  /// A process has more than the wire can tell.
  [[nodiscard]] std::uint32_t stack_free_bytes() const { return 0xffff; }
  [[nodiscard]] std::int16_t temperature_cdeg() const { return wire::kUnknownTemperature; }

  /// Lets virtual time pass to the next interrupt and runs it.
  void sleep() {
    switch (clock_.wait()) {
      case Alarm::kWindow:
        sampler_.on_window_alarm();
        break;
      case Alarm::kSettled:
        sampler_.on_settled();
        break;
      case Alarm::kBurst:
        sampler_.on_burst_done();
        break;
      case Alarm::kTick:
        clock_.set_alarm(Alarm::kTick, clock_.now_us() + surroundings_.tick_us);
        break;
    }
    if (watchdog_.expired()) {
      resets_.end(Ending::kWatchdog);
    }
  }

  /// To be called once the board has ended: what the next one finds.
  void leave() {
    surroundings_.since_us += clock_.now_us();
    surroundings_.last_reset = resets_.ending() == Ending::kWatchdog ? wire::ResetCause::kWatchdog
                                                                     : wire::ResetCause::kSoftware;
  }

  // For tests.
  [[nodiscard]] Adc& adc() { return adc_; }

 private:
  Surroundings<Link>& surroundings_;
  VirtualClock clock_;
  Emitters emitters_{clock_};
  Adc adc_;
  Sampler sampler_;
  VirtualWatchdog watchdog_{clock_};
  Light light_;
  VirtualReset resets_;
  SlowFlash flash_;
  SerialNumber id_;
};

static_assert(FirmwareBoard<Board<FileLink>>);

}  // namespace penduline::sim
