// SPDX-License-Identifier: Apache-2.0
// `penduline devices`: the boards that are plugged in, and how they are.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "hal/linux/board_connection.hpp"
#include "hal/linux/serial_devices.hpp"
#include "hal/linux/serial_port.hpp"
#include "host/cli/commands.hpp"
#include "host/cli/log.hpp"
#include "host/session/stop_signal.hpp"

namespace penduline {
namespace {

constexpr std::size_t kTableColumns = 5;
using TableRow = std::array<std::string, kTableColumns>;

/// What a port's device says of itself, or why it does not.
TableRow describe(const SerialDevice& device, const StopSignal& stop) {
  TableRow row = {device.path, device.identity.serial_number, "", "", ""};
  auto& [path, serial_number, board, firmware, state] = row;
  auto port = SerialPort::open(device.path);
  if (!port) {
    state = port.error().message.substr(device.path.size() + 2);
    return row;
  }
  const auto connection = BoardConnection::open(std::move(*port), [&] { return stop.requested(); });
  if (!connection) {
    state = "does not say Hello";
    return row;
  }
  const wire::Hello& hello = connection->hello();
  board = wire::characters_of(hello.board);
  firmware = wire::characters_of(hello.firmware);
  state = fmt::format("samples at {} Hz, emitters {}", hello.rate_millihz / 1e3,
                      wire::name_of(wire::kEmitterModes, hello.emitter_mode));
  return row;
}

/// The rows below each other, each column as wide as its widest cell.
std::string table_of(const std::vector<TableRow>& rows) {
  std::string text;
  for (const TableRow& row : rows) {
    for (std::size_t column = 0; column + 1 < kTableColumns; ++column) {
      std::size_t width = 0;
      for (const TableRow& other : rows) {
        width = std::max(width, other[column].size());
      }
      text += fmt::format("{:<{}}  ", row[column], width);
    }
    text += row.back() + '\n';
  }
  return text;
}

ExitStatus list_devices() {
  const StopSignal stop;
  const std::vector<SerialDevice> devices = serial_devices();
  std::vector<TableRow> rows = {{"port", "serial number", "board", "firmware", "state"}};
  for (const SerialDevice& device : devices) {
    if (device.is_penduline() || device.is_st_link()) {
      rows.push_back(describe(device, stop));
    }
  }
  if (rows.size() == 1) {
    return log_failure({choose_board(devices, "").reason});
  }
  fmt::print("{}", table_of(rows));
  return ExitStatus::kDone;
}

}  // namespace

void add_devices_command(CLI::App& program, ExitStatus& status) {
  CLI::App* command = program.add_subcommand("devices", "List the boards that are plugged in");
  command->footer(
      "A board is a USB device with Penduline's identity, or an ST-Link behind which a Nucleo may\n"
      "be. Each is asked who it is; one that another program reads is left alone.");
  command->final_callback([&status] { status = list_devices(); });
}

}  // namespace penduline
