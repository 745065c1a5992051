// SPDX-License-Identifier: Apache-2.0
// Tests of each command: what it answers, what it changes, and each refusal by its name.
#include <catch2/catch.hpp>
#include <cstdint>

#include "tests/unit/firmware/board_under_test.hpp"

namespace penduline::test {
namespace {

using namespace wire;

TEST_CASE("A board says who it is and how it fares when it starts", "[application]") {
  BoardUnderTest board;
  board.start();
  const std::vector<KeptFrame> frames = board.frames();
  REQUIRE(frames.size() == 2);
  CHECK(frames[0].type == Hello::kType);
  CHECK(frames[1].type == Status::kType);
  const Hello hello = board.last<Hello>();
  CHECK(hello.protocol == 1);
  CHECK(characters_of(hello.board) == "sim");
  CHECK(characters_of(hello.firmware) == PENDULINE_VERSION);
  CHECK(hello.unique_id == std::array<std::uint8_t, 8>{1, 2, 3, 4, 5, 6, 7, 8});
  CHECK(hello.tick_hz == 1'000'000);
  CHECK(hello.rate_millihz == 20'000);
  CHECK(hello.full_scale_counts == 65535);
  CHECK(hello.reference_uv == 3'300'000);
  CHECK(hello.sensor_count == 2);
  CHECK(hello.emitter_mode == EmitterMode::kSwitched);
  CHECK(hello.window_us == 556);
  CHECK(hello.conversions == 32);
}

TEST_CASE("A status comes each second", "[application]") {
  BoardUnderTest board;
  board.start();
  board.run_us(10 * kSecondUs + 10'000);
  const std::vector<Status> statuses = board.all<Status>();
  REQUIRE(statuses.size() == 11);
  for (std::size_t i = 0; i < statuses.size(); ++i) {
    CHECK(statuses[i].t_us == i * kSecondUs);
  }
  const Status& status = statuses.back();
  CHECK(status.samples == 199);
  CHECK(status.dropped_frames == 0);
  CHECK(status.bad_frames == 0);
  CHECK(status.overruns == 0);
  CHECK(status.load_permille == 0);  // the simulated main loop takes no time
  CHECK(status.temperature_cdeg == kUnknownTemperature);
  CHECK(status.reset_cause == ResetCause::kPowerOn);
  CHECK(status.store == StoreState::kEmpty);
  CHECK(status.emitter_mode == EmitterMode::kSwitched);
}

TEST_CASE("A ping is answered by a pong alone", "[application]") {
  BoardUnderTest board;
  board.start();
  board.run_us(5'000);
  const std::vector<KeptFrame> answers = board.answers_to(Ping{.token = 0xdeadbeef});
  REQUIRE(answers.size() == 1);
  const Pong pong = board.last<Pong>();
  CHECK(pong.token == 0xdeadbeef);
  CHECK(pong.t_us >= 5'000);
  CHECK(pong.t_us <= 6'000);
}

TEST_CASE("What is asked for comes before its reply", "[application]") {
  BoardUnderTest board;
  board.start();
  std::vector<KeptFrame> answers = board.answers_to(AskHello{.token = 200});
  REQUIRE(answers.size() == 2);
  CHECK(answers[0].type == Hello::kType);
  CHECK(answers[1] == KeptFrame{Reply::kType, {AskHello::kType, 200, 0}});
  answers = board.answers_to(AskStatus{.token = 201});
  REQUIRE(answers.size() == 2);
  CHECK(answers[0].type == Status::kType);
  CHECK(answers[1] == KeptFrame{Reply::kType, {AskStatus::kType, 201, 0}});
}

TEST_CASE("A rate outside 1 Hz to 1 kHz is refused and changes nothing", "[application]") {
  BoardUnderTest board;
  board.start();
  for (const std::uint32_t rate_millihz : {0U, 999U, 1'000'001U, 0xffffffffU}) {
    CHECK(board.result_of(SetRate{.token = 1, .rate_millihz = rate_millihz}) ==
          Result::kOutOfRange);
  }
  static_cast<void>(board.answers_to(AskHello{}));
  CHECK(board.last<Hello>().rate_millihz == 20'000);
  for (const std::uint32_t rate_millihz : {1'000U, 1'000'000U, 12'345U}) {
    CHECK(board.result_of(SetRate{.token = 1, .rate_millihz = rate_millihz}) == Result::kDone);
    static_cast<void>(board.answers_to(AskHello{}));
    CHECK(board.last<Hello>().rate_millihz == rate_millihz);
  }
}

TEST_CASE("An emitter mode that does not exist is refused and changes nothing", "[application]") {
  BoardUnderTest board;
  board.start();
  CHECK(board.result_of(SetEmitter{.mode = EmitterMode::kLit}) == Result::kDone);
  CHECK(board.result_of(SetEmitter{.mode = EmitterMode{3}}) == Result::kOutOfRange);
  CHECK(board.result_of(SetEmitter{.mode = EmitterMode{255}}) == Result::kOutOfRange);
  static_cast<void>(board.answers_to(AskStatus{}));
  CHECK(board.last<Status>().emitter_mode == EmitterMode::kLit);
}

TEST_CASE("A board that is to be found flickers for as long as asked", "[application]") {
  BoardUnderTest board;
  board.start();
  const auto flashes = [&] {
    int count = 0;
    bool before = board.board().indicator().lit();
    for (int i = 0; i < 1000; ++i) {
      board.run_us(1'000);
      const bool lit = board.board().indicator().lit();
      count += lit && !before ? 1 : 0;
      before = lit;
    }
    return count;
  };
  CHECK(flashes() == 1);
  CHECK(board.result_of(Identify{.token = 1, .seconds = 3}) == Result::kDone);
  CHECK(flashes() == 5);
  CHECK(board.result_of(Identify{.token = 1, .seconds = 0}) == Result::kDone);
  CHECK(flashes() == 1);
}

TEST_CASE("A command that the firmware does not know is refused by its token", "[application]") {
  BoardUnderTest board;
  board.start();
  const KeptFrame unknown_with_token{Reply::kType, {0x7f, 9, 1}};
  CHECK(board.answers_to(frame_of(0x7f, {9, 1, 2, 3})) ==
        std::vector<KeptFrame>{unknown_with_token});
  CHECK(board.answers_to(frame_of(0x7f, {})) ==
        std::vector<KeptFrame>{KeptFrame{Reply::kType, {0x7f, 0, 1}}});
}

TEST_CASE("A command that is too short is refused, a longer one is a newer host's",
          "[application]") {
  BoardUnderTest board;
  board.start();
  for_each_message([&]<Message Kind>(const Kind&) {
    if (Kind::kType <= 0x40) {
      return;
    }
    CAPTURE(Kind::kName);
    // A token and nothing behind it, or not even that.
    const Bytes payload(kPayloadBytes<Kind> - 1, 5);
    const std::uint8_t token = payload.empty() ? std::uint8_t{0} : std::uint8_t{5};
    static_cast<void>(board.answers_to(frame_of(Kind::kType, payload)));
    const Reply reply = board.last<Reply>();
    CHECK(reply.command == Kind::kType);
    CHECK(reply.token == token);
    CHECK(reply.result == Result::kWrongLength);
  });
  CHECK(board.answers_to(frame_of(AskHello::kType, {7, 1, 2})).size() == 2);
  CHECK(board.last<Reply>().result == Result::kDone);
}

TEST_CASE("Messages of a board that come to a board are not commands", "[application]") {
  BoardUnderTest board;
  board.start();
  for (const int type : {0x00, 0x01, 0x06, 0x40, 0x80, 0xff}) {
    CAPTURE(type);
    static_cast<void>(board.answers_to(frame_of(static_cast<std::uint8_t>(type), {1, 2, 3})));
    CHECK(board.all<Reply>().empty());
  }
}

TEST_CASE("Garbage and cut commands cost themselves only", "[application]") {
  BoardUnderTest board;
  board.start();
  const Bytes ask = frame_of(AskHello{.token = 1});
  Bytes cut(ask.begin(), ask.begin() + 4);
  cut.push_back(0);
  const Bytes garbage = joined({bytes_of("de ad be ef 00 01 00 ff 00"), cut});
  CHECK(board.answers_to(joined({ask, garbage, ask})).size() == 4);
  static_cast<void>(board.answers_to(AskStatus{}));
  CHECK(board.last<Status>().bad_frames == 4);
}

TEST_CASE("A flood of commands costs no sample, and what it costs is counted", "[application]") {
  constexpr std::uint32_t kFlood = 2000;
  BoardUnderTest board;
  board.start();
  for (std::uint32_t i = 0; i < kFlood; ++i) {
    board.send_bytes(frame_of(Ping{.token = i}));
  }
  board.run_us(kSecondUs);
  CHECK(board.all<Pong>().size() == kFlood);
  CHECK(board.all<SampleMessage>().size() == 19);

  // Each is answered by ten times its own length: more than the board keeps for one look.
  board.forget();
  for (std::uint32_t i = 0; i < kFlood; ++i) {
    board.send_bytes(frame_of(AskHello{.token = 1}));
  }
  board.run_us(2 * kSecondUs);
  CHECK(board.all<SampleMessage>().size() == 40);
  CHECK(board.all<Hello>().size() + board.all<Reply>().size() +
            board.last<Status>().dropped_frames ==
        2 * kFlood);
}

TEST_CASE("A board that hears itself comes to rest", "[application]") {
  BoardUnderTest board;
  board.start();
  static_cast<void>(board.answers_to(AskHello{.token = 1}));
  const Bytes echo = board.link().sent;
  CHECK(board.answers_to(echo).empty());
}

}  // namespace
}  // namespace penduline::test
