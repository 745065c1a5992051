// SPDX-License-Identifier: Apache-2.0
// What a board must offer to the firmware, as concepts; each backend asserts that it models them.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <tuple>
#include <type_traits>

#include "common/wire/choices.hpp"
#include "hal/crash_record.hpp"
#include "hal/window.hpp"

namespace penduline {

/// Time since the board started, in microseconds. It never goes back and never wraps.
template <class Clock>
concept TickClock = requires(const Clock& clock) {
  { clock.now_us() } -> std::same_as<std::uint64_t>;
};

/// The infrared emitters of both sensors, switched together. Called from an interrupt.
template <class Light>
concept Emitter = requires(Light& emitter, bool lit) {
  { emitter.set(lit) } -> std::same_as<void>;
};

/// Converts bursts; called from an interrupt. Where the conversions run by themselves, their end is
/// told to `WindowSequencer::on_burst_done`.
template <class Adc>
concept BurstConverter = requires(Adc& adc, std::uint8_t first_channel, std::uint16_t* codes) {
  { Adc::kConversionNs } -> std::convertible_to<std::uint32_t>;
  /// Begins kConversionsPerBurst conversions into `codes`; true where they are there on return.
  { adc.convert(first_channel, codes) } -> std::same_as<bool>;
};

/// Calls `WindowSequencer::on_wake_up` once, a given time later. Called from an interrupt.
template <class Timer>
concept WakeUpTimer = TickClock<Timer> && requires(Timer& timer, std::uint32_t delay_us) {
  { timer.wake_after(delay_us) } -> std::same_as<void>;
};

/// Paired analogue sampling: windows at a steady rate, taken by hardware and interrupts.
template <class Sampler>
concept PairedSampler = requires(Sampler& sampler, Window& window, std::uint32_t period_us,
                                 EmitterMode mode) {
  /// How long a window lasts; shorter than any period.
  { Sampler::kWindowUs } -> std::convertible_to<std::uint32_t>;
  /// The largest code of a conversion.
  { Sampler::kTopCode } -> std::convertible_to<std::uint16_t>;
  /// Starts, or goes on with another period or mode from the next window on.
  { sampler.start(period_us, mode) } -> std::same_as<void>;
  /// Hands out the oldest window that is finished; false where there is none.
  { sampler.take(window) } -> std::same_as<bool>;
};

/// A stream of bytes to the host and back. No call waits.
template <class Link>
concept ByteLink = requires(Link& link, std::span<const std::uint8_t> out,
                            std::span<std::uint8_t> in) {
  /// How many bytes of frames may wait for it; a power of two.
  { Link::kWaitingBytes } -> std::convertible_to<std::size_t>;
  /// Takes as many of the bytes as it has room for and returns how many.
  { link.write(out) } -> std::same_as<std::size_t>;
  /// Fills in what has come and returns how many bytes.
  { link.read(in) } -> std::same_as<std::size_t>;
  /// Whether the hardware has stopped sending what it has taken, though it could.
  { link.stuck() } -> std::same_as<bool>;
  /// Whether the host asked for the bootloader beside the stream (USB's 1200-baud touch).
  { link.asks_for_bootloader() } -> std::same_as<bool>;
};

/// Resets the board unless it is fed in time.
template <class Dog>
concept Watchdog = requires(Dog& watchdog) {
  { watchdog.start() } -> std::same_as<void>;
  { watchdog.feed() } -> std::same_as<void>;
};

/// A light for the person beside the board.
template <class Light>
concept Indicator = requires(Light& indicator, bool lit) {
  { indicator.set(lit) } -> std::same_as<void>;
};

/// Restarting the board.
template <class Control>
concept Reboot = requires(Control& control) {
  /// What the hardware says of the last reset.
  { control.cause() } -> std::same_as<wire::ResetCause>;
  { control.restart() } -> std::same_as<void>;
  { control.enter_bootloader() } -> std::same_as<void>;
};

inline constexpr std::size_t kUniqueIdBytes = 8;

/// A number that no other board has.
template <class Id>
concept UniqueId = requires(const Id& id) {
  { id.unique_id() } -> std::same_as<std::array<std::uint8_t, kUniqueIdBytes>>;
};

/// A place for one block of bytes that survives resets and loss of power.
template <class Memory>
concept Store = requires(Memory& store, const Memory& unchanged,
                         std::span<const std::uint8_t> block) {
  /// All that may be there, written or not.
  { unchanged.contents() } -> std::same_as<std::span<const std::uint8_t>>;
  /// Replaces the contents' beginning; the rest is erased. False where the memory did not take it.
  /// Interrupts wait meanwhile, so windows may be lost.
  { store.replace(block) } -> std::same_as<bool>;
};

/// All of a board. The application is written against this alone.
template <class Board>
concept FirmwareBoard = requires(Board& board) {
  { Board::kName } -> std::convertible_to<std::string_view>;
  { Board::kReferenceUv } -> std::convertible_to<std::uint32_t>;
  requires TickClock<std::remove_cvref_t<decltype(board.clock())>>;
  requires PairedSampler<std::remove_cvref_t<decltype(board.sampler())>>;
  requires Watchdog<std::remove_cvref_t<decltype(board.watchdog())>>;
  requires Indicator<std::remove_cvref_t<decltype(board.indicator())>>;
  requires Reboot<std::remove_cvref_t<decltype(board.resets())>>;
  requires UniqueId<std::remove_cvref_t<decltype(board.id())>>;
  requires Store<std::remove_cvref_t<decltype(board.store())>>;
  /// A tuple of references to one or more ByteLinks.
  requires std::tuple_size_v<std::remove_cvref_t<decltype(board.links())>>
  >= 1;
  /// In memory that resets leave as it is.
  { board.crash_record() } -> std::same_as<CrashRecord&>;
  /// Never used so far.
  { board.stack_free_bytes() } -> std::same_as<std::uint32_t>;
  /// Of the chip; wire::kUnknownTemperature where it has no thermometer.
  { board.temperature_cdeg() } -> std::same_as<std::int16_t>;
  /// Waits for a window, bytes or room for bytes, unless they came since the last call; wakes at
  /// least ten times a second.
  { board.sleep() } -> std::same_as<void>;
};

}  // namespace penduline
