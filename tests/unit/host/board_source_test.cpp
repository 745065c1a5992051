// SPDX-License-Identifier: Apache-2.0
// Tests of a board as a source: its Hello, its samples, its losses and returns, damage at any byte.
#include "host/source/board_source.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdint>
#include <string>
#include <vector>

#include "host/source/port_finder.hpp"
#include "tests/unit/host/scripted_board.hpp"
#include "tests/unit/temporary_folder.hpp"

namespace {

using namespace penduline;
using namespace penduline::test;

using Seqs = std::vector<std::uint64_t>;
using Lines = std::vector<std::string>;

const std::string kHello = frame_of(hello_of_boot(1));

Seqs seqs_of(const Heard& heard) {
  Seqs seqs;
  std::ranges::transform(heard.samples, std::back_inserter(seqs), &Sample::seq);
  return seqs;
}

/// Samples from one number up to another, each a frame.
std::string samples(std::uint64_t from, std::uint64_t to) {
  std::string bytes;
  for (std::uint64_t seq = from; seq <= to; ++seq) {
    bytes += sample_frame(seq);
  }
  return bytes;
}

TEST_CASE("A recording's header is what the board's Hello says", "[board]") {
  const Heard heard = listen({{.pieces = {kHello + sample_frame(0)}}});
  CHECK(heard.header.acquisition.rate_hz == 50);
  CHECK(heard.header.acquisition.full_scale_counts == 4095);
  CHECK(heard.header.acquisition.reference_v == 3);
  CHECK(heard.header.acquisition.sensor_count == 2);
  CHECK(heard.header.board == "pico");
  CHECK(heard.header.firmware == "1.2.3");
}

TEST_CASE("Samples come in order, what a newer board says beside is skipped", "[board]") {
  const std::string unknown = frame_of(wire::Pong{}) + frame_of(wire::Ping{});
  const Heard heard = listen({{.pieces = {kHello + samples(0, 1) + unknown + sample_frame(2)}}});
  CHECK(seqs_of(heard) == Seqs{0, 1, 2});
  CHECK(heard.samples[0].readings[0].on == 1000);
  CHECK(heard.samples[0].readings[0].off == 10);
  CHECK(heard.commands.front() == wire::AskHello::kType);
}

TEST_CASE("What stands before the first Hello is old or noise, and no damage", "[board]") {
  const Heard heard =
      listen({{.pieces = {"AT+GCAP\r" + std::string(1, '\0') + sample_frame(3) + kHello,
                          sample_frame(7)}}});
  CHECK(seqs_of(heard) == Seqs{7});
  CHECK(heard.complaints == Lines{"script: the board was lost once"});
}

TEST_CASE("A board that went and did not stop loses nothing that it kept", "[board]") {
  const Heard heard = listen({{.pieces = {kHello + samples(0, 2)}},
                              {.refusal = "script: No such file or directory"},
                              {.pieces = {samples(3, 4), kHello + sample_frame(5)}}});
  CHECK(seqs_of(heard) == Seqs{0, 1, 2, 3, 4, 5});
  CHECK(std::ranges::none_of(heard.samples, [](const Sample& one) { return one.flags != 0; }));
  CHECK(heard.events == Lines{"connected", "disconnected", "connected", "disconnected"});
  REQUIRE(heard.said.size() == 3);
  CHECK(heard.said[0] == "script: gone; waiting for it");
  CHECK(heard.said[1].starts_with("script: the board is back after 0."));
  CHECK(heard.said[1].ends_with(" s, it had not stopped"));
}

TEST_CASE("The first sample after a new start says so, though the board's own is lost", "[board]") {
  const std::string again = frame_of(hello_of_boot(2));
  const Heard gone =
      listen({{.pieces = {kHello + samples(0, 2)}}, {.pieces = {again + samples(4, 5)}}});
  REQUIRE(seqs_of(gone) == Seqs{0, 1, 2, 4, 5});
  CHECK(gone.samples[3].flags == flag::kRestarted);
  CHECK(gone.samples[4].flags == 0);
  CHECK(gone.events == Lines{"connected", "disconnected", "connected", "boot", "disconnected"});
  CHECK(gone.said[1].ends_with(" s, it has started anew"));

  // On a line that stays, the board's Hello tells.
  const Heard stayed = listen({{.pieces = {kHello + samples(0, 2) + again + samples(0, 1)}}});
  REQUIRE(seqs_of(stayed) == Seqs{0, 1, 2, 0, 1});
  CHECK(stayed.samples[3].flags == flag::kRestarted);
  CHECK(stayed.events == Lines{"connected", "boot", "disconnected"});
}

TEST_CASE("A board is waited for with one message, or not at all", "[board]") {
  const std::vector<Life> lives = {
      {.refusal = "port: none"}, {.refusal = "port: none"}, {.pieces = {kHello + sample_frame(0)}}};
  const Heard heard = listen(lives);
  CHECK(seqs_of(heard) == Seqs{0});
  CHECK(heard.said.front() == "port: none; waiting for it (Ctrl-C ends)");
  CHECK(std::ranges::count(heard.said, heard.said.front()) == 1);
  CHECK(listen(lives, {.once = true}).error == "port: none");
  const Heard once = listen({{.pieces = {kHello + sample_frame(0)}}}, {.once = true});
  CHECK(seqs_of(once) == Seqs{0});
  CHECK(once.error == "script: gone");
}

TEST_CASE("Each attempt to talk to a board is told: no port, no answer, an answer", "[board]") {
  const Heard heard = listen({{.refusal = "script: none"},
                              {.pieces = {"AT+GCAP\r"}},
                              {.pieces = {kHello, sample_frame(0)}}});
  CHECK(seqs_of(heard) == Seqs{0});
  REQUIRE(heard.attempts.size() >= 3);
  CHECK(heard.attempts[0] == BoardAttempt::kNoPort);
  CHECK(heard.attempts[1] == BoardAttempt::kNoAnswer);
  CHECK(heard.attempts[2] == BoardAttempt::kAnswer);
}

TEST_CASE("A board that is just being reset may be late, even where none is waited for",
          "[board]") {
  const std::vector<Life> lives = {{.refusal = "script: none"},
                                   {.refusal = "script: none"},
                                   {.pieces = {kHello, sample_frame(0)}}};
  const Heard heard = listen(lives, {.once = true, .patience = std::chrono::seconds(10)});
  CHECK(seqs_of(heard) == Seqs{0});
  CHECK(heard.error == "script: gone");
  CHECK(listen(lives, {.once = true, .patience = std::chrono::milliseconds(1)}).error ==
        "script: none");
}

TEST_CASE("Another board in the place of the first is refused by its number", "[board]") {
  wire::Hello other = hello_of_boot(9);
  other.unique_id[7] = 0x22;
  const Heard heard = listen({{.pieces = {kHello + sample_frame(0)}},
                              {.pieces = {frame_of(other) + sample_frame(1)}},
                              {.pieces = {kHello + sample_frame(2)}}});
  CHECK(seqs_of(heard) == Seqs{0, 2});
  CHECK(
      heard.said[1] ==
      "script: found board E6605838831B2C22, expected E6605838831B2C21; waiting for the right one");
}

TEST_CASE("A rate that is asked for is set, and set again after a new start", "[board]") {
  const Heard heard = listen({{.pieces = {kHello, samples(0, 1)}},
                              {.pieces = {frame_of(hello_of_boot(2)), sample_frame(0)}}},
                             {.rate_millihz = 100'000});
  CHECK(heard.header.acquisition.rate_hz == 100);
  CHECK(std::ranges::count(heard.commands, wire::SetRate::kType) == 2);
  CHECK(seqs_of(heard) == Seqs{1, 0});
}

TEST_CASE("A run begins with the rate that is asked for: the window on its way is another's",
          "[board]") {
  CHECK(seqs_of(listen({{.pieces = {kHello, samples(0, 2)}}}, {.rate_millihz = 100'000})) ==
        Seqs{1, 2});
  CHECK(seqs_of(listen({{.pieces = {kHello, samples(0, 2)}}}, {.rate_millihz = 50'000})) ==
        Seqs{0, 1, 2});
}

TEST_CASE("After a new start on a line that stays the board is told its rate again", "[board]") {
  const std::string again = frame_of(hello_of_boot(2));
  const Heard heard = listen({{.pieces = {kHello, samples(0, 2), again, samples(0, 1)}}},
                             {.rate_millihz = 100'000});
  CHECK(seqs_of(heard) == Seqs{1, 2, 0, 1});
  CHECK(std::ranges::count(heard.commands, wire::SetRate::kType) == 2);
  CHECK(heard.said.front() == "script: the board has started anew");
}

TEST_CASE("A board whose emitters are still as somebody else wanted them says so", "[board]") {
  wire::Hello lit = hello_of_boot(1);
  lit.emitter_mode = wire::EmitterMode::kLit;
  const std::vector<Life> lives = {{.pieces = {frame_of(lit) + sample_frame(0)}}};
  CHECK(listen(lives).said.front() ==
        "script: the board's emitters are still lit; --emitter switched has it measure the room's "
        "light, too");
  CHECK(listen(lives, {.emitter_mode = wire::EmitterMode::kLit}).said.front() ==
        "script: gone; waiting for it");
}

TEST_CASE("A board of another protocol is told and read", "[board]") {
  wire::Hello newer = hello_of_boot(1);
  newer.protocol = 2;
  const Heard heard = listen({{.pieces = {frame_of(newer) + sample_frame(0)}}});
  CHECK(heard.said.front() ==
        "script: the board speaks protocol 2, this program 1: what is not known is skipped");
  CHECK(seqs_of(heard) == Seqs{0});
}

TEST_CASE("Frames that the board dropped are told, not those of before", "[board]") {
  const Heard heard = listen({{.pieces = {kHello + frame_of(wire::Status{.dropped_frames = 30}) +
                                          frame_of(wire::Status{.dropped_frames = 42})}}},
                             {.once = true});
  CHECK(heard.complaints.front() == "script: the board dropped 12 frames that nobody read in time");
}

/// A stream with samples only after its Hello, in frames of one length.
constexpr std::uint64_t kLast = 9;
const std::string kStream = kHello + std::string(1, '\0') + samples(0, kLast);
const std::size_t kFrame = sample_frame(0).size();
const std::size_t kStart = kStream.size() - (kLast + 1) * kFrame;

TEST_CASE("Cut or stalled at any byte, the stream comes whole", "[board]") {
  Seqs all;
  for (std::uint64_t seq = 0; seq <= kLast; ++seq) {
    all.push_back(seq);
  }
  for (std::size_t at = 1; at < kStream.size(); ++at) {
    CAPTURE(at);
    const std::string head = kStream.substr(0, at);
    const std::string tail = kStream.substr(at);
    const Heard split = listen({{.pieces = {head, tail}}}, {.once = true});
    CHECK(seqs_of(split) == all);
    const Heard stalled = listen({{.pieces = {head, "", "", tail}}}, {.once = true});
    CHECK(seqs_of(stalled) == all);
    CHECK(stalled.complaints == Lines{"script: the board was lost once"});
  }
}

TEST_CASE("A byte that is flipped or dropped costs the frames that it touches, each counted",
          "[board]") {
  for (std::size_t at = kStart; at < kStream.size(); ++at) {
    for (const bool dropped : {false, true}) {
      CAPTURE(at, dropped);
      std::string damaged = kStream;
      if (dropped) {
        damaged.erase(at, 1);
      } else {
        damaged[at] = static_cast<char>(damaged[at] ^ 0x20);
      }
      const Heard heard = listen({{.pieces = {damaged}}}, {.once = true});
      const std::uint64_t hit = (at - kStart) / kFrame;
      // The zero at a frame's end is all that parts it from the next.
      const bool was_end = (at - kStart) % kFrame == kFrame - 1;
      Seqs expected;
      for (std::uint64_t seq = 0; seq <= kLast; ++seq) {
        if (seq != hit && !(was_end && seq == hit + 1)) {
          expected.push_back(seq);
        }
      }
      CHECK(seqs_of(heard) == expected);
      if (!was_end || hit < kLast) {
        // A byte that becomes zero parts its frame in two.
        CHECK(heard.complaints.front() == (!dropped && damaged[at] == 0
                                               ? "script: 2 damaged frames"
                                               : "script: 1 damaged frames"));
      }
    }
  }
}

TEST_CASE("Gone at any byte and back, only the frame on its way is lost", "[board]") {
  for (std::size_t at = kStart; at < kStream.size(); ++at) {
    CAPTURE(at);
    const std::uint64_t whole = (at - kStart) / kFrame;
    // The board's next frame is the one after that which was cut.
    const bool cut = (at - kStart) % kFrame != 0;
    const std::uint64_t next = whole + (cut ? 1 : 0);
    const Heard heard = listen({{.pieces = {kStream.substr(0, at)}},
                                {.pieces = {kHello + (next > kLast ? "" : samples(next, kLast))}}});
    Seqs expected;
    for (std::uint64_t seq = 0; seq <= kLast; ++seq) {
      if (seq < whole || seq >= next) {
        expected.push_back(seq);
      }
    }
    CHECK(seqs_of(heard) == expected);
  }
}

TEST_CASE("A file of a board's bytes ends, and a pipe that is no board's is refused", "[board]") {
  const TemporaryFolder folder;
  const auto open = [&](const std::string& bytes) {
    return BoardSource::open(
        port_opener(*parse_uri("serial:" + folder.write("board", bytes))), {},
        {.say = [](const std::string&) {}, .stop_requested = [] { return false; }});
  };
  const auto source = open(kHello + samples(0, 1));
  REQUIRE(source);
  Sample sample;
  std::vector<ReadResult> results;
  while (results.empty() || results.back() != ReadResult::kEnded) {
    results.push_back((*source)->read(sample).value());
  }
  CHECK(std::ranges::count(results, ReadResult::kSample) == 2);
  CHECK((*source)->complaints().empty());
  CHECK(folder.relative(open("").error().message) ==
        "board: found no bytes, expected a Penduline board that says Hello");
  CHECK(folder.relative(open("seq,t_us\n0,1\n").error().message) ==
        "board: found bytes that are not its frames, expected a Penduline board that says Hello");
}

}  // namespace
