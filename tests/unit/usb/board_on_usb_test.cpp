// SPDX-License-Identifier: Apache-2.0
// Tests of a board as the source `usb:`, from its bulk endpoints to samples.
#include <catch2/catch.hpp>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "host/source/board_source.hpp"
#include "host/source/port_finder.hpp"
#include "tests/unit/host/scripted_board.hpp"
#include "tests/unit/usb/mocked_bus.hpp"
#include "tests/unit/usb/mocked_usb_board.hpp"

namespace {

using namespace penduline;
using namespace penduline::test;

using Lines = std::vector<std::string>;
using Seqs = std::vector<std::uint64_t>;
using Transfer = MockedUsbBoard::Transfer;

/// Says Hello when it is asked to, and then the bytes.
std::function<std::string(const std::string&)> firmware(std::uint32_t boot_id,
                                                        const std::string& then) {
  return [boot_id, then, decoder = std::make_shared<wire::Decoder>()](const std::string& sent) {
    std::string answer;
    for (const char byte : sent) {
      const auto frame = decoder->push(static_cast<std::uint8_t>(byte));
      if (frame && frame->type == wire::AskHello::kType) {
        answer += frame_of(hello_of_boot(boot_id)) + then;
      }
    }
    return answer;
  };
}

/// The source `usb:`, and what comes out of it.
struct Listener {
  std::unique_ptr<Source> source;
  Lines said{};
  Lines events{};
  std::vector<Sample> samples{};
  std::string error{};

  explicit Listener(const std::string& uri, const BoardSettings& settings = {}) {
    constexpr std::chrono::seconds kPatience{10};
    source = BoardSource::open(port_opener(*parse_uri(uri)), settings,
                               {.say = [this](const std::string& text) { said.push_back(text); },
                                .stop_requested =
                                    [until = std::chrono::steady_clock::now() + kPatience] {
                                      return std::chrono::steady_clock::now() > until;
                                    }})
                 .value();
  }

  /// Reads until so many samples or messages are there, or it fails.
  void read_until(std::size_t sample_count, std::size_t message_count) {
    constexpr int kMostReadings = 100;
    for (int i = 0; i < kMostReadings && error.empty() &&
                    (samples.size() < sample_count || said.size() < message_count);
         ++i) {
      Sample sample;
      const auto result = source->read(sample);
      for (const RecordingEvent& event : source->events()) {
        events.push_back(event.kind);
      }
      if (!result) {
        error = result.error().message;
      } else if (*result == ReadResult::kSample) {
        samples.push_back(sample);
      }
    }
  }

  [[nodiscard]] Seqs seqs() const {
    Seqs seqs;
    for (const Sample& sample : samples) {
      seqs.push_back(sample.seq);
    }
    return seqs;
  }
};

/// The same board at another place and under another number of the bus.
PluggedDevice replugged() {
  PluggedDevice device;
  device.port = "1-4";
  device.address = 7;
  return device;
}

TEST_CASE("A board's samples come out of its bulk endpoint", "[board_on_usb]") {
  MockedBus bus;
  MockedUsbBoard board(bus);
  board.answer_by(firmware(1, sample_frame(0)));
  // Frames that two transfers part, and an empty packet between.
  const std::string frames = sample_frame(1) + sample_frame(2) + sample_frame(3);
  board.send("");
  Listener listener("usb:1209:0001");
  CHECK(listener.source->header().serial == "E6605838831B2C21");
  CHECK(listener.source->header().acquisition.rate_hz == 50);
  board.send(frames.substr(0, 40));
  board.send("");
  board.send(frames.substr(40));
  listener.read_until(4, 0);
  CHECK(listener.seqs() == Seqs{0, 1, 2, 3});
  CHECK(listener.samples[3].readings[0].on == 1000);
  CHECK(listener.source->complaints().empty());
}

TEST_CASE("A board that is unplugged and back under another number is read on", "[board_on_usb]") {
  const auto [boot_id, flags, news] = GENERATE(table<std::uint32_t, std::uint32_t, std::string>(
      {{1, 0, ", it had not stopped"}, {2, flag::kRestarted, ", it has started anew"}}));
  MockedBus bus;
  MockedUsbBoard board(bus);
  board.answer_by(firmware(1, sample_frame(0)));
  Listener listener("usb:1209:0001");
  listener.read_until(1, 0);

  board.unplug_during(Transfer::kRead, -ESHUTDOWN, sample_frame(1));
  listener.read_until(2, 1);
  board.unplug();
  CHECK(listener.said ==
        Lines{"usb:1209:0001: gone: No such device (it may have been disconnected); waiting for "
              "it"});

  MockedUsbBoard back(bus, replugged());
  back.answer_by(firmware(boot_id, sample_frame(2)));
  listener.read_until(3, 2);
  CHECK(listener.seqs() == Seqs{0, 1, 2});
  CHECK(listener.samples.back().flags == flags);
  REQUIRE(listener.said.size() == 2);
  CHECK(listener.said[1].starts_with("usb:1209:0001:E6605838831B2C21: the board is back after "));
  CHECK(listener.said[1].ends_with(news));
  CHECK(back.owner(1) == "Penduline");
  listener.source.reset();  // before its boards
}

TEST_CASE("A board that comes back beside another one of its kind is told from it by its number",
          "[board_on_usb]") {
  MockedBus bus;
  MockedUsbBoard board(bus);
  board.answer_by(firmware(1, sample_frame(0)));
  PluggedDevice neighbour;
  neighbour.port = "1-2";
  neighbour.address = 3;
  neighbour.identity.serial_number = "E6605838831B2C22";
  const MockedUsbBoard other(bus, neighbour);
  Listener listener("usb:1209:0001:E6605838831B2C21");
  board.unplug_during(Transfer::kRead, -EPROTO);
  listener.read_until(1, 1);
  board.unplug();
  MockedUsbBoard back(bus, replugged());
  back.answer_by(firmware(1, sample_frame(1)));
  listener.read_until(2, 2);
  CHECK(listener.seqs() == Seqs{0, 1});
  CHECK(other.requests().empty());
  listener.source.reset();  // before its boards
}

TEST_CASE("Where nothing is to be waited for, a board that is unplugged ends the run",
          "[board_on_usb]") {
  MockedBus bus;
  MockedUsbBoard board(bus);
  board.answer_by(firmware(1, sample_frame(0)));
  Listener listener("usb:1209:0001", {.once = true});
  board.unplug_during(Transfer::kRead, -EPROTO);
  listener.read_until(2, 0);
  CHECK(listener.seqs() == Seqs{0});
  CHECK(listener.error == "usb:1209:0001: gone: Input/Output Error");
}

}  // namespace
