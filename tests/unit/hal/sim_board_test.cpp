// SPDX-License-Identifier: Apache-2.0
// Tests of the simulated board's pieces: time, light, flash file, link.
#include <unistd.h>

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <vector>

#include "hal/sim/board.hpp"
#include "tests/unit/hal/simulated_rigs.hpp"
#include "tests/unit/temporary_folder.hpp"

namespace penduline::test {
namespace {

using namespace sim;

TEST_CASE("Time passes to the next alarm, and one that was passed comes late", "[sim_board]") {
  VirtualClock clock;
  clock.set_alarm(Alarm::kTick, 1000);
  clock.set_alarm(Alarm::kWindow, 500);
  clock.wake_after(500);
  CHECK(clock.wait() == Alarm::kWindow);
  CHECK(clock.wait() == Alarm::kSettled);
  CHECK(clock.now_us() == 500);
  clock.pass_us(2000);
  CHECK(clock.wait() == Alarm::kTick);
  CHECK(clock.now_us() == 2500);
}

TEST_CASE("Light is seen 50 us after its switch, which the firmware has to wait for",
          "[sim_board]") {
  VirtualClock clock;
  Emitters emitters(clock);
  clock.pass_us(1000);
  emitters.set(true);
  CHECK_FALSE(emitters.seen_lit());
  clock.pass_us(49);
  emitters.set(true);  // no switch
  CHECK_FALSE(emitters.seen_lit());
  clock.pass_us(1);
  CHECK(emitters.seen_lit());
  emitters.set(false);
  CHECK(emitters.seen_lit());
  clock.pass_us(50);
  CHECK_FALSE(emitters.seen_lit());
  static_assert(Emitters::kRiseUs < kSettlingUs);
}

/// The codes of a burst of a still rig whose lit pins stand at so many volts beyond 5/3.
std::array<std::uint16_t, kConversionsPerBurst> burst_at(double ambient_v) {
  SimulationSettings settings = ideal({});
  settings.ambient_v = ambient_v;
  SimulatedRig rig(paper_rig(), settings);
  rig.advance_to(0);
  VirtualClock clock;
  Emitters emitters(clock);
  Adc adc(clock, emitters, rig, 3.3);
  emitters.set(true);
  clock.pass_us(Emitters::kRiseUs);
  std::array<std::uint16_t, kConversionsPerBurst> codes{};
  CHECK_FALSE(adc.convert(1, codes.data()));
  CHECK(clock.wait() == Alarm::kBurst);
  CHECK(clock.now_us() == Emitters::kRiseUs + 64);
  return codes;
}

TEST_CASE("A burst has the pins' voltages as codes, clipped at both ends", "[sim_board]") {
  // A gap of 20 mm is (0.02 - 0.01) / 0.006 = 1.6667 V: 2068.2 codes of 4095 in 3.3 V.
  CHECK(burst_at(0).front() == 2068);
  CHECK(burst_at(0).back() == 2068);
  CHECK(burst_at(2).front() == 4095);
  CHECK(burst_at(-2).front() == 0);
}

TEST_CASE("A watchdog that was never started does not bite, one that is not fed does",
          "[sim_board]") {
  VirtualClock clock;
  VirtualWatchdog watchdog(clock);
  clock.pass_us(10 * VirtualWatchdog::kTimeoutUs);
  CHECK_FALSE(watchdog.expired());
  watchdog.start();
  clock.pass_us(VirtualWatchdog::kTimeoutUs);
  CHECK_FALSE(watchdog.expired());
  watchdog.feed();
  clock.pass_us(VirtualWatchdog::kTimeoutUs + 1);
  CHECK(watchdog.expired());
}

TEST_CASE("A flash file keeps its sector for the next process", "[sim_board]") {
  const TemporaryFolder folder;
  const std::string path = folder.path("flash");
  const std::vector<std::uint8_t> block = {1, 2, 3};
  {
    auto flash = FlashFile::open(path);
    REQUIRE(flash);
    CHECK(std::ranges::all_of(flash->contents(), [](auto byte) { return byte == 0xff; }));
    REQUIRE(flash->replace(block));
  }
  const auto flash = FlashFile::open(path);
  REQUIRE(flash);
  REQUIRE(flash->contents().size() == FlashFile::kSectorBytes);
  CHECK(std::ranges::equal(flash->contents().first(3), block));
  CHECK(flash->contents()[3] == 0xff);
}

TEST_CASE("A flash file that cannot be read, or written, is told", "[sim_board]") {
  const TemporaryFolder folder;
  CHECK_FALSE(FlashFile::open(folder.path("")));
  const auto too_long =
      FlashFile::open(folder.write("long", std::string(FlashFile::kSectorBytes + 1, 'x')));
  REQUIRE_FALSE(too_long);
  CHECK(too_long.error().message ==
        folder.path("long") + ": found a longer file, expected a store of 4096 bytes at most");
  auto nowhere = FlashFile::open(folder.path("no/such/folder"));
  REQUIRE(nowhere);  // as a file that is not there yet
  CHECK_FALSE(nowhere->replace(std::array<std::uint8_t, 1>{}));
  CHECK_FALSE(FlashFile().replace(std::vector<std::uint8_t>(FlashFile::kSectorBytes + 1)));
}

struct Pipe {
  std::array<int, 2> ends{};
  Pipe() { REQUIRE(::pipe(ends.data()) == 0); }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  ~Pipe() {
    for (const int end : ends) {
      ::close(end);
    }
  }
};

TEST_CASE("A link never waits: no bytes, no room, and a broken end are told at once",
          "[sim_board]") {
  const std::array<std::uint8_t, 64> bytes{1, 2, 3};
  std::array<std::uint8_t, 100> back{};
  Pipe pipe;
  FileLink link(pipe.ends[0], pipe.ends[1]);
  CHECK(link.read(back) == 0);
  CHECK(link.write(bytes) == bytes.size());
  CHECK(link.read(back) == bytes.size());
  CHECK(std::equal(bytes.begin(), bytes.end(), back.begin()));
  CHECK_FALSE(link.asks_for_bootloader());

  std::size_t filled = 0;
  while (const std::size_t taken = link.write(bytes)) {
    filled += taken;
  }
  CHECK(filled >= 4096);
  CHECK_FALSE(link.broken());
  CHECK_FALSE(link.wait_for_room(0));

  FileLink nothing(-1, -1);
  CHECK(nothing.read(back) == 0);
  CHECK(nothing.write(bytes) == 0);
}

TEST_CASE("A pseudo-terminal passes every byte as it is", "[sim_board]") {
  auto pty = Terminal::open_pseudo();
  if (!pty && !std::filesystem::exists("/dev/pts/ptmx")) {
    WARN("no pseudo-terminals here, for /dev/pts is not mounted: not tested");
    return;
  }
  REQUIRE(pty);
  std::ofstream theirs(pty->path(), std::ios::binary);
  FileLink link(pty->descriptor(), pty->descriptor());
  for (int byte = 0; byte < 256; ++byte) {
    theirs.put(static_cast<char>(byte));
  }
  theirs.flush();
  std::array<std::uint8_t, 300> came{};
  std::size_t size = 0;
  for (int i = 0; i < 1000 && size < 256; ++i) {
    size += link.read(std::span(came).subspan(size));
    ::usleep(1000);
  }
  REQUIRE(size == 256);
  for (std::size_t i = 0; i < 256; ++i) {
    CHECK(came[i] == i);
  }
}

}  // namespace
}  // namespace penduline::test
