// SPDX-License-Identifier: Apache-2.0
// What the board says to the host.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <tuple>

#include "common/wire/choices.hpp"
#include "common/wire/field.hpp"
#include "common/wire/text.hpp"

namespace penduline::wire {

/// Raised when an old peer would misread a new one; fields added at an end do not.
inline constexpr std::uint8_t kProtocolVersion = 1;

/// `Status::temperature_cdeg` where the board has no thermometer.
inline constexpr std::int16_t kUnknownTemperature = 0x7FFF;

/// Who the board is and how it samples.
struct Hello {
  static constexpr std::uint8_t kType = 0x01;
  static constexpr std::string_view kName = "Hello";

  std::uint8_t protocol = kProtocolVersion;
  Text board{};
  Text firmware{};
  std::array<std::uint8_t, 8> unique_id{};
  std::uint32_t boot_id = 0;
  std::uint32_t tick_hz = 0;
  std::uint32_t rate_millihz = 0;
  std::uint16_t full_scale_counts = 0;
  std::uint32_t reference_uv = 0;
  std::uint8_t sensor_count = 0;
  EmitterMode emitter_mode = EmitterMode::kSwitched;
  std::uint16_t window_us = 0;
  std::uint16_t conversions = 0;

  static constexpr auto fields() {
    return std::tuple{
        Field{"protocol", &Hello::protocol, "version of the protocol, 1"},
        Field{"board", &Hello::board, "name of the board"},
        Field{"firmware", &Hello::firmware, "version of the firmware"},
        Field{"unique_id", &Hello::unique_id, "the chip's own number, in the order it is printed"},
        Field{"boot_id", &Hello::boot_id, "another number after every start"},
        Field{"tick_hz", &Hello::tick_hz, "ticks per second of the clock behind `t_us`"},
        Field{"rate_millihz", &Hello::rate_millihz, "sample rate in thousandths of a hertz"},
        Field{"full_scale_counts", &Hello::full_scale_counts, "counts at the reference voltage"},
        Field{"reference_uv", &Hello::reference_uv, "the ADC's reference voltage in microvolts"},
        Field{"sensor_count", &Hello::sensor_count, "how many sensors the board reads"},
        Field{"emitter_mode", &Hello::emitter_mode, "`EmitterMode`"},
        Field{"window_us", &Hello::window_us, "length of a sampling window in microseconds"},
        Field{"conversions", &Hello::conversions, "ADC conversions in one lit reading"},
    };
  }
};

/// One paired reading of both sensors; see `Sample`, and the conversions in sample_message.hpp.
struct SampleMessage {
  static constexpr std::uint8_t kType = 0x02;
  static constexpr std::string_view kName = "SampleMessage";

  std::uint64_t seq = 0;
  std::uint64_t t_us = 0;
  std::uint16_t x_on = 0;
  std::uint16_t x_off = 0;
  std::uint16_t y_on = 0;
  std::uint16_t y_off = 0;
  std::uint8_t flags = 0;

  static constexpr auto fields() {
    return std::tuple{
        Field{"seq", &SampleMessage::seq, "counted from 0, never repeated within one boot"},
        Field{"t_us", &SampleMessage::t_us, "board's clock at the middle of the window"},
        Field{"x_on", &SampleMessage::x_on, "mean counts, emitter lit"},
        Field{"x_off", &SampleMessage::x_off, "mean counts, emitter dark: ambient light"},
        Field{"y_on", &SampleMessage::y_on, "mean counts, emitter lit"},
        Field{"y_off", &SampleMessage::y_off, "mean counts, emitter dark: ambient light"},
        Field{"flags", &SampleMessage::flags, "the device's flags, those below 256"},
    };
  }
};

/// How the board fares. Counts are since the start; they wrap round.
struct Status {
  static constexpr std::uint8_t kType = 0x03;
  static constexpr std::string_view kName = "Status";

  std::uint64_t t_us = 0;
  std::uint64_t samples = 0;
  std::uint32_t dropped_frames = 0;
  std::uint32_t bad_frames = 0;
  std::uint32_t overruns = 0;
  std::uint16_t late_max_us = 0;
  std::uint16_t load_permille = 0;
  std::int16_t temperature_cdeg = kUnknownTemperature;
  std::uint16_t stack_free_bytes = 0;
  ResetCause reset_cause = ResetCause::kUnknown;
  std::uint16_t resets = 0;
  std::uint32_t fault_pc = 0;
  std::uint16_t fault_line = 0;
  Text fault_file{};
  StoreState store = StoreState::kEmpty;
  std::uint32_t rate_millihz = 0;
  EmitterMode emitter_mode = EmitterMode::kSwitched;

  static constexpr auto fields() {
    return std::tuple{
        Field{"t_us", &Status::t_us, "board's clock now"},
        Field{"samples", &Status::samples, "samples taken"},
        Field{"dropped_frames", &Status::dropped_frames, "frames not sent, the ring being full"},
        Field{"bad_frames", &Status::bad_frames, "frames received damaged"},
        Field{"overruns", &Status::overruns, "windows that were due and not taken"},
        Field{"late_max_us", &Status::late_max_us,
              "worst lateness of a window's first conversion since the last `Status` that was not "
              "asked for"},
        Field{"load_permille", &Status::load_permille,
              "the main loop's busy time since the last `Status` that was not asked for"},
        Field{"temperature_cdeg", &Status::temperature_cdeg,
              "the chip's, in hundredths of a degree Celsius; 0x7fff unknown"},
        Field{"stack_free_bytes", &Status::stack_free_bytes, "stack that was never used"},
        Field{"reset_cause", &Status::reset_cause, "`ResetCause` of this boot"},
        Field{"resets", &Status::resets, "starts since power came on"},
        Field{"fault_pc", &Status::fault_pc, "where the last fault happened, 0 none"},
        Field{"fault_line", &Status::fault_line, "line of the last failed assertion, 0 none"},
        Field{"fault_file", &Status::fault_file, "its file, the name's first 16 bytes"},
        Field{"store", &Status::store, "`StoreState`"},
        Field{"rate_millihz", &Status::rate_millihz, "sample rate now"},
        Field{"emitter_mode", &Status::emitter_mode, "`EmitterMode` now"},
    };
  }
};

/// The board's own estimate, where it has a rig; see `angles_message_of`.
struct AnglesMessage {
  static constexpr std::uint8_t kType = 0x04;
  static constexpr std::string_view kName = "AnglesMessage";

  std::uint64_t seq = 0;
  std::int64_t t_us = 0;
  float theta1_rad = 0;
  float theta2_rad = 0;
  float residual_m = 0;
  std::uint32_t flags = 0;
  float omega1_rad_s = 0;
  float omega2_rad_s = 0;
  float sigma1_rad = 0;
  float sigma2_rad = 0;

  static constexpr auto fields() {
    return std::tuple{
        Field{"seq", &AnglesMessage::seq, "the newest sample that went in"},
        Field{"t_us", &AnglesMessage::t_us, "the moment that the angles refer to"},
        Field{"theta1_rad", &AnglesMessage::theta1_rad, "NaN where there is no answer"},
        Field{"theta2_rad", &AnglesMessage::theta2_rad, "NaN where there is no answer"},
        Field{"residual_m", &AnglesMessage::residual_m, "RMS misfit of the gaps; NaN likewise"},
        Field{"flags", &AnglesMessage::flags, "the estimate's flags"},
        Field{"omega1_rad_s", &AnglesMessage::omega1_rad_s,
              "rate of theta1; NaN of an estimator that does not know it"},
        Field{"omega2_rad_s", &AnglesMessage::omega2_rad_s, "rate of theta2; NaN likewise"},
        Field{"sigma1_rad", &AnglesMessage::sigma1_rad,
              "standard deviation of theta1; NaN of an estimator that does not know it"},
        Field{"sigma2_rad", &AnglesMessage::sigma2_rad,
              "standard deviation of theta2; NaN likewise"},
    };
  }
};

/// Answers `Ping`, for the synchronisation of clocks.
struct Pong {
  static constexpr std::uint8_t kType = 0x05;
  static constexpr std::string_view kName = "Pong";

  std::uint32_t token = 0;
  std::uint64_t t_us = 0;

  static constexpr auto fields() {
    return std::tuple{
        Field{"token", &Pong::token, "that of the `Ping`"},
        Field{"t_us", &Pong::t_us, "board's clock when the `Ping` was read"},
    };
  }
};

/// What became of a command.
struct Reply {
  static constexpr std::uint8_t kType = 0x06;
  static constexpr std::string_view kName = "Reply";

  std::uint8_t command = 0;
  std::uint8_t token = 0;
  Result result = Result::kDone;

  static constexpr auto fields() {
    return std::tuple{
        Field{"command", &Reply::command, "type byte of the command"},
        Field{"token", &Reply::token, "that of the command"},
        Field{"result", &Reply::result, "`Result`"},
    };
  }
};

}  // namespace penduline::wire
