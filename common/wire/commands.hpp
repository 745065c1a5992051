// SPDX-License-Identifier: Apache-2.0
// What the host says to the board. Each but `Ping` begins with a token that its `Reply` echoes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <tuple>

#include "common/wire/choices.hpp"
#include "common/wire/field.hpp"

namespace penduline::wire {

/// The type bytes of commands, those to come included: a board answers these and no others.
inline constexpr std::uint8_t kFirstCommandType = 0x41;
inline constexpr std::uint8_t kLastCommandType = 0x7F;

/// Sample rates that `SetRate` may ask for.
inline constexpr std::uint32_t kLeastRateMillihz = 1'000;
inline constexpr std::uint32_t kMostRateMillihz = 1'000'000;

/// Bytes of a rig that one `RigPart` carries.
inline constexpr std::size_t kRigPartBytes = 48;

/// What every command's token means.
inline constexpr std::string_view kTokenMeaning = "the host's own number for this command";

/// Asks for the board's clock; answered by `Pong`.
struct Ping {
  static constexpr std::uint8_t kType = 0x41;
  static constexpr std::string_view kName = "Ping";

  std::uint32_t token = 0;

  static constexpr auto fields() { return std::tuple{Field{"token", &Ping::token, kTokenMeaning}}; }
};

/// Answered by `Hello`, then `Reply`.
struct AskHello {
  static constexpr std::uint8_t kType = 0x42;
  static constexpr std::string_view kName = "AskHello";

  std::uint8_t token = 0;

  static constexpr auto fields() {
    return std::tuple{Field{"token", &AskHello::token, kTokenMeaning}};
  }
};

/// Answered by `Status`, then `Reply`.
struct AskStatus {
  static constexpr std::uint8_t kType = 0x43;
  static constexpr std::string_view kName = "AskStatus";

  std::uint8_t token = 0;

  static constexpr auto fields() {
    return std::tuple{Field{"token", &AskStatus::token, kTokenMeaning}};
  }
};

/// Sets the sample rate.
struct SetRate {
  static constexpr std::uint8_t kType = 0x44;
  static constexpr std::string_view kName = "SetRate";

  std::uint8_t token = 0;
  std::uint32_t rate_millihz = 0;

  static constexpr auto fields() {
    return std::tuple{
        Field{"token", &SetRate::token, kTokenMeaning},
        Field{"rate_millihz", &SetRate::rate_millihz, "1000 to 1000000: 1 Hz to 1 kHz"},
    };
  }
};

/// Sets how the emitters are lit.
struct SetEmitter {
  static constexpr std::uint8_t kType = 0x45;
  static constexpr std::string_view kName = "SetEmitter";

  std::uint8_t token = 0;
  EmitterMode mode = EmitterMode::kSwitched;

  static constexpr auto fields() {
    return std::tuple{
        Field{"token", &SetEmitter::token, kTokenMeaning},
        Field{"mode", &SetEmitter::mode, "`EmitterMode`"},
    };
  }
};

/// Lets the board's light blink, so that a person finds it among others.
struct Identify {
  static constexpr std::uint8_t kType = 0x46;
  static constexpr std::string_view kName = "Identify";

  std::uint8_t token = 0;
  std::uint8_t seconds = 0;

  static constexpr auto fields() {
    return std::tuple{
        Field{"token", &Identify::token, kTokenMeaning},
        Field{"seconds", &Identify::seconds, "how long; 0 stops it"},
    };
  }
};

/// Restarts the board, after the `Reply`.
struct Reboot {
  static constexpr std::uint8_t kType = 0x47;
  static constexpr std::string_view kName = "Reboot";

  std::uint8_t token = 0;
  RebootTarget target = RebootTarget::kApplication;

  static constexpr auto fields() {
    return std::tuple{
        Field{"token", &Reboot::token, kTokenMeaning},
        Field{"target", &Reboot::target, "`RebootTarget`"},
    };
  }
};

/// Begins the upload of a rig (rig_image.hpp), and forgets one that was begun before.
struct BeginRig {
  static constexpr std::uint8_t kType = 0x48;
  static constexpr std::string_view kName = "BeginRig";

  std::uint8_t token = 0;
  std::uint16_t size_bytes = 0;
  std::uint32_t crc = 0;

  static constexpr auto fields() {
    return std::tuple{
        Field{"token", &BeginRig::token, kTokenMeaning},
        Field{"size_bytes", &BeginRig::size_bytes, "of the whole image, up to 1024"},
        Field{"crc", &BeginRig::crc, "CRC-32 of the whole image"},
    };
  }
};

/// A piece of the image; the same piece may come twice.
struct RigPart {
  static constexpr std::uint8_t kType = 0x49;
  static constexpr std::string_view kName = "RigPart";

  std::uint8_t token = 0;
  std::uint16_t offset = 0;
  std::uint8_t count = 0;
  std::array<std::uint8_t, kRigPartBytes> bytes{};

  static constexpr auto fields() {
    return std::tuple{
        Field{"token", &RigPart::token, kTokenMeaning},
        Field{"offset", &RigPart::offset, "where in the image the piece begins"},
        Field{"count", &RigPart::count, "how many of `bytes` count, 1 to 48"},
        Field{"bytes", &RigPart::bytes, "the piece, filled up with zeros"},
    };
  }
};

/// Checks, stores and uses the uploaded rig.
struct EndRig {
  static constexpr std::uint8_t kType = 0x4A;
  static constexpr std::string_view kName = "EndRig";

  std::uint8_t token = 0;

  static constexpr auto fields() {
    return std::tuple{Field{"token", &EndRig::token, kTokenMeaning}};
  }
};

/// Forgets the stored rig.
struct EraseRig {
  static constexpr std::uint8_t kType = 0x4B;
  static constexpr std::string_view kName = "EraseRig";

  std::uint8_t token = 0;

  static constexpr auto fields() {
    return std::tuple{Field{"token", &EraseRig::token, kTokenMeaning}};
  }
};

}  // namespace penduline::wire
