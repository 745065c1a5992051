// SPDX-License-Identifier: Apache-2.0
// From the cable to the board's own words.
#include "host/doctor/board_checks.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/wire/commands.hpp"
#include "hal/linux/board_connection.hpp"
#include "hal/linux/serial_devices.hpp"
#include "host/source/port_finder.hpp"

namespace penduline {
namespace {

/// Where a Pico shows up that waits for firmware.
constexpr const char* kPicoDisk = "/dev/disk/by-label/RPI-RP2";

/// What penduline-sim-board and its like call themselves.
constexpr std::string_view kSimulatedBoard = "sim";
/// Of the main loop's time.
constexpr unsigned kMostLoadPermille = 900;

Finding bad(std::string subject, std::string found, std::string advice) {
  return {.health = Health::kBad,
          .subject = std::move(subject),
          .found = std::move(found),
          .advice = std::move(advice)};
}

Finding no_board(std::string reason) {
  std::error_code not_there;
  return std::filesystem::exists(kPicoDisk, not_there)
             ? bad("board", std::move(reason) + "; but a Pico without firmware is there",
                   "flash it: scripts/flash pico")
             : bad("board", std::move(reason),
                   "plug the board in by a cable that carries data, not only power; a Pico must be "
                   "flashed once (scripts/flash pico)");
}

/// A command for each of several boards; "" where there are not several.
std::string each_board(const std::vector<SerialDevice>& devices, TypedNames names) {
  std::string commands;
  int count = 0;
  for (const SerialDevice& device : devices) {
    if (device.is_penduline()) {
      names.source = "auto:" + device.identity.serial_number;
      commands += (count++ > 0 ? " or " : "") + names.again();
    }
  }
  return count > 1 ? commands : "";
}

/// The path of the port that `uri` means, or why there is none. Empty for a board without one.
tl::expected<std::string, Finding> port_path(const SourceUri& uri, const TypedNames& names) {
  if (uri.kind == SourceUri::Kind::kSerial) {
    return uri.path;
  }
  if (uri.kind == SourceUri::Kind::kUsb) {
    return "";
  }
  const std::vector<SerialDevice> devices = serial_devices();
  AutoChoice choice = choose_board(devices, uri.serial_number);
  if (choice.path.empty()) {
    const std::string each = each_board(devices, names);
    return tl::unexpected(each.empty()
                              ? no_board(std::move(choice.reason))
                              : bad("board", std::move(choice.reason), "say which one: " + each));
  }
  return choice.path;
}

std::optional<Finding> check_permission(const std::string& path) {
  if (path.empty() || ::access(path.c_str(), R_OK | W_OK) == 0) {
    return std::nullopt;
  }
  if (errno == EACCES || errno == EPERM) {
    return bad("permission", path + ": you may not read and write it",
               "install the udev rules (they come with the package), or join the group that has "
               "it: sudo usermod -aG dialout $USER, then log in again");
  }
  return no_board(path + ": no such port");
}

Finding firmware_of(const wire::Hello& hello) {
  const std::string_view version = wire::characters_of(hello.firmware);
  const std::string found = fmt::format("{} with firmware {}, protocol {}",
                                        wire::characters_of(hello.board), version, hello.protocol);
  if (hello.protocol != wire::kProtocolVersion) {
    return {
        .health = Health::kDoubtful,
        .subject = "firmware",
        .found = fmt::format("{}; this program speaks protocol {}", found, wire::kProtocolVersion),
        .advice = "flash the firmware that came with this program (scripts/flash)"};
  }
  if (version != PENDULINE_VERSION) {
    return {.health = Health::kDoubtful,
            .subject = "firmware",
            .found = fmt::format("{}; this program is {}", found, PENDULINE_VERSION),
            .advice =
                "they understand each other; flash the firmware that came with this program "
                "to have both alike"};
  }
  return {.subject = "firmware", .found = found};
}

/// The answer to AskStatus; none where it does not come.
std::optional<wire::Status> ask_status(BoardConnection& connection, const StopSignal& stop) {
  constexpr std::chrono::seconds kPatience{2};
  constexpr std::chrono::milliseconds kFrameWait{100};
  if (!connection.send(wire::AskStatus{})) {
    return std::nullopt;
  }
  const auto until = std::chrono::steady_clock::now() + kPatience;
  while (std::chrono::steady_clock::now() < until && !stop.requested()) {
    const auto frame = connection.next_frame(kFrameWait);
    if (!frame) {
      return std::nullopt;
    }
    if (*frame && (*frame)->type == wire::Status::kType) {
      return wire::read_message<wire::Status>((*frame)->payload);
    }
  }
  return std::nullopt;
}

/// Its load and temperature, as far as it has them.
std::string condition_of(const wire::Status& status, bool simulated) {
  constexpr double kCentidegrees = 100;
  std::string condition = "it has not failed since it was plugged in";
  if (!simulated) {
    condition +=
        fmt::format("; its processor is busy {} % of the time", status.load_permille / 10.0);
  }
  if (status.temperature_cdeg != wire::kUnknownTemperature) {
    condition += fmt::format("{} {:.0f} degrees Celsius", simulated ? "; it has" : " and has",
                             status.temperature_cdeg / kCentidegrees);
  }
  return condition;
}

}  // namespace

Finding check_health(const wire::Hello& hello, const std::optional<wire::Status>& status,
                     const TypedNames& names) {
  if (!status) {
    return {.health = Health::kDoubtful,
            .subject = "health",
            .found = "the board does not say how it fares",
            .advice =
                "where it cannot be written to, as through a serial line's receiver alone, "
                "it takes no commands either"};
  }
  if (status->fault_pc != 0 || status->fault_line != 0) {
    return {.health = Health::kDoubtful,
            .subject = "health",
            .found = fmt::format("it has failed since it was plugged in (at {:#x}, {}:{})",
                                 status->fault_pc, wire::characters_of(status->fault_file),
                                 status->fault_line),
            .advice = "flash the newest firmware; if it fails again, tell us these numbers"};
  }
  if (status->store == wire::StoreState::kDamaged) {
    return {.health = Health::kDoubtful,
            .subject = "health",
            .found = "the rig that it keeps is damaged, and ignored",
            .advice = "store it again: " + names.run("--upload-rig gn")};
  }
  const bool simulated = wire::characters_of(hello.board) == kSimulatedBoard;
  if (!simulated && status->load_permille > kMostLoadPermille) {
    return {.health = Health::kDoubtful,
            .subject = "health",
            .found = condition_of(*status, simulated),
            .advice = "samples may come late: sample more slowly: " +
                      names.run_slower(status->rate_millihz / 1e3)};
  }
  return {.subject = "health", .found = condition_of(*status, simulated)};
}

Findings check_board(const SourceUri& uri, const TypedNames& names, const StopSignal& stop) {
  const auto path = port_path(uri, names);
  if (!path) {
    return {path.error()};
  }
  if (auto refused = check_permission(*path)) {
    return {std::move(*refused)};
  }
  auto port = port_opener(uri)(false);
  if (!port) {
    return {bad("board", port.error().message,
                "if another program has it, end that one (a terminal, another 'penduline run', "
                "the service); for usb: the udev rules must let you open it")};
  }
  Findings findings = {{.subject = "board", .found = (*port)->name()}};
  auto connection = BoardConnection::open(std::move(*port), [&] { return stop.requested(); });
  if (!connection && stop.requested()) {
    return findings;
  }
  if (!connection) {
    findings.push_back(bad("firmware", connection.error().message,
                           "press the board's reset, or unplug it; if it still says nothing, "
                           "flash it (scripts/flash)"));
    return findings;
  }
  findings.push_back(firmware_of(connection->hello()));
  const auto status = ask_status(*connection, stop);
  if (status || !stop.requested()) {
    findings.push_back(check_health(connection->hello(), status, names));
  }
  return findings;
}

}  // namespace penduline
