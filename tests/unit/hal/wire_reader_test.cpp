// SPDX-License-Identifier: Apache-2.0
// Tests of reading a board's frames: the greeting, samples, damage, the end.
#include "hal/linux/wire_reader.hpp"

#include <catch2/catch.hpp>
#include <cstdint>
#include <string>
#include <vector>

#include "common/wire/frame.hpp"
#include "tests/unit/temporary_folder.hpp"

namespace {

using namespace penduline;
using namespace penduline::test;

template <class Message>
std::string frame_of(const Message& message) {
  std::vector<std::uint8_t> bytes(wire::kFrameBytes<Message>);
  bytes.resize(wire::encode_frame(message, bytes));
  return {bytes.begin(), bytes.end()};
}

const std::string kHello = frame_of(wire::Hello{.rate_millihz = 50'000,
                                                .full_scale_counts = 4095,
                                                .reference_uv = 3'000'000,
                                                .sensor_count = 2});

std::string sample_frame(std::uint64_t seq) {
  return frame_of(wire::SampleMessage{.seq = seq, .t_us = 20'000 * seq, .x_on = 1000, .x_off = 10});
}

/// What came out of a stream of bytes.
struct ReadOut {
  std::vector<std::uint64_t> seqs;
  std::vector<std::string> complaints;
  std::string error;
  Acquisition<double> acquisition;
};

ReadOut read_bytes(const std::string& bytes) {
  const TemporaryFolder folder;
  auto reader = WireReader::open(folder.write("board", bytes));
  if (!reader) {
    return {.seqs = {},
            .complaints = {},
            .error = folder.relative(reader.error().message),
            .acquisition = {}};
  }
  ReadOut out{.seqs = {}, .complaints = {}, .error = "", .acquisition = reader->acquisition()};
  for (Sample sample; reader->read(sample).value();) {
    out.seqs.push_back(sample.seq);
    CHECK(sample.readings[0].on == 1000);
    CHECK(sample.readings[0].off == 10);
  }
  for (const std::string& complaint : reader->complaints()) {
    out.complaints.push_back(folder.relative(complaint));
  }
  return out;
}

using Seqs = std::vector<std::uint64_t>;
using Lines = std::vector<std::string>;

TEST_CASE("The acquisition is what the board's Hello says", "[wire_reader]") {
  const ReadOut out = read_bytes(kHello + sample_frame(0));
  CHECK(out.acquisition.rate_hz == 50);
  CHECK(out.acquisition.full_scale_counts == 4095);
  CHECK(out.acquisition.reference_v == 3);
  CHECK(out.acquisition.sensor_count == 2);
}

TEST_CASE("Samples come in order until the stream ends", "[wire_reader]") {
  const ReadOut out = read_bytes(kHello + sample_frame(0) + sample_frame(1) + sample_frame(2));
  CHECK(out.seqs == Seqs{0, 1, 2});
  CHECK(out.complaints.empty());
}

TEST_CASE("What stands before the Hello is skipped", "[wire_reader]") {
  const ReadOut out = read_bytes("AT+GCAP\r" + std::string(1, '\0') + kHello + sample_frame(7));
  CHECK(out.seqs == Seqs{7});
  CHECK(out.complaints == Lines{"board: 1 damaged frames"});
}

TEST_CASE("A damaged frame costs itself and is counted", "[wire_reader]") {
  std::string bad = sample_frame(1);
  bad[5] ^= 0x10;
  const ReadOut out = read_bytes(kHello + sample_frame(0) + bad + sample_frame(2));
  CHECK(out.seqs == Seqs{0, 2});
  CHECK(out.complaints == Lines{"board: 1 damaged frames"});
}

TEST_CASE("Other messages, also unknown ones, are skipped", "[wire_reader]") {
  CHECK(read_bytes(kHello + frame_of(wire::Pong{}) + sample_frame(0) + frame_of(wire::Ping{}) +
                   sample_frame(1))
            .seqs == Seqs{0, 1});
}

TEST_CASE("Frames that the board dropped are told", "[wire_reader]") {
  const ReadOut out = read_bytes(kHello + frame_of(wire::Status{.dropped_frames = 30}) +
                                 frame_of(wire::Status{.dropped_frames = 42}));
  CHECK(out.complaints == Lines{"board: the board dropped 12 frames that nobody read in time"});
}

TEST_CASE("What the board dropped while nobody listened is no fault of this stream",
          "[wire_reader]") {
  CHECK(read_bytes(kHello + frame_of(wire::Status{.dropped_frames = 30})).complaints.empty());
}

TEST_CASE("A last frame that is cut is no sample", "[wire_reader]") {
  const std::string last = sample_frame(1);
  CHECK(read_bytes(kHello + sample_frame(0) + last.substr(0, last.size() - 3)).seqs == Seqs{0});
}

TEST_CASE("A stream without Hello is no board's", "[wire_reader]") {
  CHECK(read_bytes("").error ==
        "board: found no bytes, expected a Penduline board that says Hello");
  CHECK(read_bytes("seq,t_us\n0,1\n").error ==
        "board: found bytes that are not its frames, expected a Penduline board that says Hello");
}

TEST_CASE("A port that is not there is named", "[wire_reader]") {
  CHECK(WireReader::open("/dev/nowhere").error().message ==
        "/dev/nowhere: No such file or directory");
}

}  // namespace
