// SPDX-License-Identifier: Apache-2.0
// Tests of the rig on the board: upload, store, and the angles that it then streams.
#include <catch2/catch.hpp>
#include <cstdint>

#include "common/pipeline.hpp"
#include "common/swing_tracker.hpp"
#include "tests/unit/firmware/board_under_test.hpp"

namespace penduline::test {
namespace {

using namespace wire;

StoreState store_of(BoardUnderTest& board) {
  static_cast<void>(board.answers_to(AskStatus{}));
  return board.last<Status>().store;
}

/// The frames behind the last reply.
std::vector<KeptFrame> frames_after_reply(const BoardUnderTest& board) {
  std::vector<KeptFrame> frames;
  for (const KeptFrame& frame : board.frames()) {
    frames.push_back(frame);
    if (frame.type == Reply::kType) {
      frames.clear();
    }
  }
  return frames;
}

/// The payload of the angles that the host's own code makes of the same sample.
template <class Estimator>
Bytes angles_payload(Estimator& estimator, const KeptFrame& sample) {
  const auto message = read_message<SampleMessage>(sample.payload);
  const Bytes frame = frame_of(angles_message_of(estimator.update(wire::sample_of(*message))));
  return frames_in(frame).at(0).payload;
}

/// `Estimator` is the one of `kind`.
template <class Estimator>
void check_same_angles(OnboardEstimator kind, std::uint32_t rate_millihz) {
  CAPTURE(rate_millihz);
  BoardUnderTest board(swinging_rig());
  board.start();
  REQUIRE(board.upload(image_of(BoardRig{.rig = two_sensor_rig(), .estimator = kind})) ==
          Result::kDone);
  // It also has the estimator start over, so both sides begin with the next sample.
  REQUIRE(board.result_of(SetRate{.rate_millihz = rate_millihz}) == Result::kDone);
  board.run_us(10 * kSecondUs);

  Estimator estimator(two_sensor_rig(), {.rate_hz = static_cast<float>(rate_millihz) / 1000,
                                         .full_scale_counts = 65535,
                                         .reference_v = 3.3F,
                                         .sensor_count = 2});
  Bytes expected;
  std::size_t compared = 0;
  for (const KeptFrame& frame : frames_after_reply(board)) {
    if (frame.type == SampleMessage::kType) {
      expected = angles_payload(estimator, frame);
    } else if (frame.type == AnglesMessage::kType) {
      REQUIRE(frame.payload == expected);
      ++compared;
    }
  }
  CHECK(compared >= rate_millihz / 100 - 10);
  const AnglesMessage angles = board.last<AnglesMessage>();
  CHECK((angles.flags & ~flag::kStray) == 0);
  CHECK(std::abs(angles.theta1_rad) < from_degrees(6));
  CHECK(angles.residual_m < 1e-4F);
}

TEST_CASE("On-board angles are bit for bit the host's of the same samples", "[application]") {
  check_same_angles<Pipeline<float>>(OnboardEstimator::kGaussNewton, 20'000);
  check_same_angles<Pipeline<float>>(OnboardEstimator::kGaussNewton, 200'000);
  check_same_angles<SwingTracker<float>>(OnboardEstimator::kKalman, 20'000);
  check_same_angles<SwingTracker<float>>(OnboardEstimator::kKalman, 100'000);
}

TEST_CASE("Faster than the Kalman filter is, the board samples and finds no angles",
          "[application]") {
  BoardUnderTest board(swinging_rig());
  board.start();
  REQUIRE(board.upload(image_of(BoardRig{
              .rig = two_sensor_rig(), .estimator = OnboardEstimator::kKalman})) == Result::kDone);
  board.run_us(kSecondUs);
  CHECK(board.last<AnglesMessage>().sigma1_rad > 0);
  REQUIRE(board.result_of(SetRate{.rate_millihz = kMostKalmanMillihz + 1000}) == Result::kDone);
  board.forget();
  board.run_us(kSecondUs);
  CHECK(board.all<SampleMessage>().size() >= 100);
  CHECK(board.all<AnglesMessage>().empty());
  CHECK(store_of(board) == StoreState::kValid);
}

TEST_CASE("Each estimate comes after its sample, with the same seq", "[application]") {
  BoardUnderTest board(swinging_rig());
  board.start();
  REQUIRE(board.upload(image_of(two_sensor_rig())) == Result::kDone);
  board.forget();
  board.run_us(kSecondUs);
  const std::vector<KeptFrame> frames = board.frames();
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (frames[i].type == SampleMessage::kType) {
      REQUIRE(i + 1 < frames.size());
      CHECK(frames[i + 1].type == AnglesMessage::kType);
      CHECK(std::equal(frames[i].payload.begin(), frames[i].payload.begin() + 8,
                       frames[i + 1].payload.begin()));
    }
  }
}

TEST_CASE("Without a rig there are no angles", "[application]") {
  BoardUnderTest board;
  board.start();
  board.run_us(kSecondUs);
  CHECK(store_of(board) == StoreState::kEmpty);
  CHECK(board.all<AnglesMessage>().empty());
}

TEST_CASE("A stored rig survives a reset, until it is erased", "[application]") {
  BoardUnderTest board;
  board.start();
  REQUIRE(board.upload(image_of(two_sensor_rig())) == Result::kDone);
  CHECK(store_of(board) == StoreState::kValid);
  REQUIRE(board.result_of(wire::Reboot{}) == Result::kDone);
  REQUIRE(board.ending() == sim::Ending::kRestart);
  board.forget();
  board.start();
  CHECK(board.last<Status>().store == StoreState::kValid);
  board.run_us(kSecondUs);
  CHECK(board.all<AnglesMessage>().size() == 19);

  CHECK(board.result_of(EraseRig{.token = 3}) == Result::kDone);
  board.forget();
  board.run_us(kSecondUs);
  CHECK(board.all<AnglesMessage>().empty());
  CHECK(store_of(board) == StoreState::kEmpty);
}

TEST_CASE("A damaged store is told and not used", "[application]") {
  BoardUnderTest board;
  Bytes block(64, 0x42);
  REQUIRE(board.surroundings().flash.replace(block));
  board.start();
  CHECK(board.last<Status>().store == StoreState::kDamaged);
  board.run_us(kSecondUs);
  CHECK(board.all<AnglesMessage>().empty());
  CHECK(board.upload(image_of(two_sensor_rig())) == Result::kDone);
  CHECK(store_of(board) == StoreState::kValid);
}

TEST_CASE("Each wrong upload is refused by its name, and the stored rig stays", "[application]") {
  BoardUnderTest board;
  board.start();
  const Bytes image = image_of(two_sensor_rig());
  REQUIRE(board.upload(image) == Result::kDone);

  CHECK(board.result_of(EndRig{.token = 1}) == Result::kNoUpload);
  CHECK(board.result_of(RigPart{.token = 2, .count = 1}) == Result::kNoUpload);
  CHECK(board.result_of(BeginRig{.token = 3, .size_bytes = 1025}) == Result::kOutOfRange);
  REQUIRE(board.result_of(BeginRig{.token = 4, .size_bytes = 50, .crc = 1}) == Result::kDone);
  CHECK(board.result_of(RigPart{.token = 5, .offset = 3, .count = 48}) == Result::kOutOfRange);
  CHECK(board.result_of(RigPart{.token = 6, .offset = 2, .count = 48}) == Result::kIncomplete);
  CHECK(board.result_of(EndRig{.token = 7}) == Result::kIncomplete);
  REQUIRE(board.result_of(RigPart{.token = 8, .count = 48}) == Result::kDone);
  REQUIRE(board.result_of(RigPart{.token = 9, .offset = 2, .count = 48}) == Result::kDone);
  CHECK(board.result_of(EndRig{.token = 10}) == Result::kDamaged);

  // Bytes that are no rig, and a rig of three sensors where the board has two.
  CHECK(board.upload(Bytes(50, 1)) == Result::kInvalidRig);
  CHECK(board.upload(image_of(linear_rig(three_sensor_layout<float>()))) == Result::kInvalidRig);
  CHECK(board.upload(Bytes(image.begin(), image.end() - 1)) == Result::kInvalidRig);
  CHECK(store_of(board) == StoreState::kValid);
  CHECK(image_of(*read_rig(board.surroundings().flash.contents()).rig) == image);
}

TEST_CASE("A flash that does not take the rig is told", "[application]") {
  BoardUnderTest board;
  board.start();
  board.surroundings().flash.wear_out();
  CHECK(board.upload(image_of(two_sensor_rig())) == Result::kStoreFailed);
  CHECK(board.result_of(EraseRig{}) == Result::kStoreFailed);
  CHECK(store_of(board) == StoreState::kEmpty);
}

}  // namespace
}  // namespace penduline::test
