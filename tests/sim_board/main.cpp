// SPDX-License-Identifier: Apache-2.0
// `penduline-sim-board`: the firmware as a Linux process, on a terminal or on stdout.
//
// It stands among the tests because it needs both the firmware and the host's reader of rig files,
// which know nothing of each other.
#include <fmt/format.h>

#include <unistd.h>
#include <CLI/CLI.hpp>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <exception>
#include <optional>
#include <string>
#include <utility>

#include "firmware/application.hpp"
#include "hal/sim/board.hpp"
#include "host/cli/estimation_options.hpp"
#include "host/cli/log.hpp"
#include "host/cli/simulation_options.hpp"
#include "host/session/stop_signal.hpp"

namespace penduline {
namespace {

using std::chrono::steady_clock;
using Surroundings = sim::Surroundings<sim::FileLink>;

struct Options {
  SimulationOptions simulation;
  std::string rig_path;
  std::string store_path;
  std::string link = "pty";
  bool fast = false;
  std::uint64_t tick_us = 1000;
};

/// Says when the virtual time may go on, and when it is over.
class Pace {
 public:
  Pace(const Options& options, const Surroundings& surroundings)
      : fast_(options.fast),
        end_us_(options.simulation.seconds
                    ? static_cast<std::uint64_t>(std::llround(*options.simulation.seconds * 1e6))
                    : UINT64_MAX),
        link_(surroundings.link) {
    if (!fast_) {
      // For whoever compares the board's time with the host's.
      const std::chrono::duration<double> start = start_.time_since_epoch();
      log_info(fmt::format("time 0 at {:.6f} s of CLOCK_MONOTONIC", start.count()));
    }
  }

  /// Waits for the real time, or as fast as possible for the one who reads.
  void wait_for(std::uint64_t virtual_us) const {
    if (!fast_) {
      stop_.sleep_until(start_ + std::chrono::microseconds(virtual_us));
      return;
    }
    constexpr int kMillisecondsBetweenLooks = 100;
    while (!stop_.requested() && !link_.wait_for_room(kMillisecondsBetweenLooks)) {
    }
  }

  [[nodiscard]] bool over(std::uint64_t virtual_us) const {
    return virtual_us >= end_us_ || stop_.requested() || link_.broken();
  }

 private:
  bool fast_;
  std::uint64_t end_us_;
  const sim::FileLink& link_;
  StopSignal stop_;
  steady_clock::time_point start_ = steady_clock::now();
};

/// One life of the board, from power-on or reset to its end; none where the time was over first.
std::optional<sim::Ending> live(Surroundings& surroundings, const Pace& pace) {
  const std::uint64_t since_us = surroundings.since_us;
  sim::Board board(surroundings);
  Application application(board);
  application.start();
  application.step();
  while (!board.resets().ending() && !pace.over(since_us + board.clock().now_us())) {
    application.sleep();
    pace.wait_for(since_us + board.clock().now_us());
    if (!board.resets().ending()) {
      application.step();
    }
  }
  board.leave();
  return board.resets().ending();
}

/// Lives on until the time is over, or for ever in the bootloader.
ExitStatus run_board(Surroundings& surroundings, const Options& options) {
  const Pace pace(options, surroundings);
  while (const auto ending = live(surroundings, pace)) {
    if (*ending == sim::Ending::kBootloader) {
      log_info("in the bootloader, where a simulated board has nothing to do");
      break;
    }
    log_info(*ending == sim::Ending::kWatchdog ? "restarted by the watchdog" : "restarted");
  }
  log_info(
      fmt::format("{:.3f} s of virtual time", static_cast<double>(surroundings.since_us) / 1e6));
  return ExitStatus::kDone;
}

/// Makes what is around the board; `terminal` is where it is not to be on stdout.
tl::expected<Surroundings, Error> make_surroundings(const Options& options,
                                                    const std::optional<sim::Terminal>& terminal) {
  const auto file = load_rig(options.rig_path);
  if (!file) {
    return tl::unexpected(file.error());
  }
  if (file->rig.layout.count != kChannels) {
    return failure(fmt::format("{}: found {} sensors, expected {}: as many as a board reads",
                               options.rig_path, file->rig.layout.count, kChannels));
  }
  auto flash =
      options.store_path.empty() ? sim::FlashFile() : sim::FlashFile::open(options.store_path);
  if (!flash) {
    return tl::unexpected(flash.error());
  }
  const SimulationSettings settings = simulation_settings(options.simulation, file->rig);
  Surroundings surroundings{
      .rig = {file->rig, settings},
      .link = terminal ? sim::FileLink(terminal->descriptor(), terminal->descriptor())
                       : sim::FileLink(STDIN_FILENO, STDOUT_FILENO),
      .flash = *flash,
      .serial_number = settings.seed};
  surroundings.tick_us = options.tick_us;
  // In real time two runs are two boots; as fast as possible one seed gives one stream.
  const std::int64_t now_ns = std::chrono::system_clock::now().time_since_epoch().count();
  surroundings.kept.boot_id = static_cast<std::uint32_t>(settings.seed) ^
                              (options.fast ? 0U : static_cast<std::uint32_t>(now_ns));
  return surroundings;
}

ExitStatus start_board(const Options& options) {
  std::optional<sim::Terminal> terminal;
  if (options.link != "stdout") {
    auto opened = options.link == "pty" ? sim::Terminal::open_pseudo()
                                        : sim::Terminal::open_device(options.link);
    if (!opened) {
      return log_failure(opened.error());
    }
    terminal.emplace(std::move(*opened));
  }
  auto surroundings = make_surroundings(options, terminal);
  if (!surroundings) {
    return log_failure(surroundings.error());
  }
  if (terminal) {
    log_info(fmt::format("link {}", terminal->path()));
  }
  return run_board(*surroundings, options);
}

void add_options(CLI::App& program, Options& options) {
  add_rig_option(program, options.rig_path);
  program
      .add_option(
          "--link", options.link,
          "pty: a new pseudo-terminal, told on stderr; stdout: frames on stdout, commands on "
          "stdin;\nor the path of a serial device")
      ->type_name("pty|stdout|PATH")
      ->capture_default_str();
  program.add_flag("--fast", options.fast,
                   "Virtual time as fast as the other end reads, not the real one");
  program
      .add_option("--tick-us", options.tick_us,
                  "How often it looks what has come on its link; many boards look less often")
      ->check(CLI::Range(100, 50'000).description(""))
      ->type_name("US")
      ->capture_default_str();
  program
      .add_option("--store", options.store_path,
                  "A file that keeps what the firmware stores in its flash; else it is forgotten")
      ->type_name("FILE");
  add_simulation_options(program, options.simulation, "How long, in virtual time; else endless");
  // These are the firmware's own to decide.
  for (const char* name :
       {"--ideal", "--rate", "--adc-bits", "--conversions", "--emitter-always-lit"}) {
    program.remove_option(program.get_option(name));
  }
}

int run_program(int argc, char** argv) {
  start_log();
  std::signal(SIGPIPE, SIG_IGN);  // a reader that goes is the link's to notice
  Options options;
  ExitStatus status = ExitStatus::kDone;
  CLI::App program(
      "Penduline's firmware as a Linux process, on a simulated pendulum.\n"
      "Its bytes are those of a board (docs/protocol.md).",
      "penduline-sim-board");
  add_options(program, options);
  program.footer(
      "Runs until --seconds or Ctrl-C.\n\n"
      "  penduline-sim-board --rig docs/rigs/paper.toml --case conical\n"
      "  penduline-sim-board --rig docs/rigs/paper.toml --link stdout --fast --seconds 60 > "
      "frames");
  program.final_callback([&] { status = start_board(options); });
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    program.exit(error);
    return static_cast<int>(error.get_exit_code() == 0 ? ExitStatus::kDone : ExitStatus::kUsage);
  }
  return static_cast<int>(status);
}

}  // namespace
}  // namespace penduline

int main(int argc, char** argv) {
  try {
    return penduline::run_program(argc, argv);
  } catch (const std::exception& error) {
    return static_cast<int>(penduline::log_failure({error.what()}));
  }
}
