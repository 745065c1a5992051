// SPDX-License-Identifier: Apache-2.0
// Tests of a rig's image: its bytes, and the refusal of every number that would break the pipeline.
#include "common/wire/rig_image.hpp"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cstdint>
#include <limits>

#include "tests/unit/common/test_rig.hpp"
#include "tests/unit/common/wire_examples.hpp"

namespace penduline::test {
namespace {

using namespace wire;

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

/// One sensor of each response model, each with a noise of its own.
BoardRig example_rig() {
  constexpr std::array kVolts = {0.31F, 0.42F, 0.55F};
  constexpr std::array kGaps = {0.026F, 0.020F, 0.016F};
  Rig<float> rig;
  rig.pendulum = {.length_m = 0.3F, .mass_kg = 0.1F, .gravity_m_s2 = 9.8F, .damping_per_s = 0.01F};
  rig.disc_diameter_m = 0.12F;
  rig.layout =
      layout_of<float>({{0.02, 0, 0}, {0, 0.02, 0}, {-0.02, 0, 0.001}, {0, -0.02, 0}}, 0.02);
  rig.responses[0] = {.model = LinearResponse<float>{0.031F, -0.006F}};
  rig.responses[1] = {.model = TableResponse<float>{MonotoneCubic<float>(kVolts, kGaps)},
                      .nearest_m = 0.016F,
                      .farthest_m = 0.026F};
  rig.responses[2] = {.model = InverseSquareResponse<float>{2e-4F, 0.004F, 0.05F},
                      .nearest_m = 0.002F,
                      .farthest_m = 0.05F,
                      .peak_m = 0.004F};
  rig.responses[3] = {.model = PolynomialResponse<float>{{0.03F, -0.012F, 0.001F}, 3, 0, 2},
                      .nearest_m = 0.005F,
                      .farthest_m = 0.03F};
  rig.filter = FilterDesign<float>{.order = 15, .cutoff_of_nyquist = 0.15F};
  rig.noise = {{{.volts = 0.0005F, .gap_m = 10e-6F},
                {.volts = 0.001F, .gap_m = 20e-6F},
                {.volts = 0.0005F, .gap_m = 0},
                {.volts = 0, .gap_m = 50e-6F}}};
  rig.trust = {.length_share = 0.02F,
               .damping_per_s = 0.05F,
               .offset_m = 0.001F,
               .acceleration_rad_s15 = 0.002F,
               .damping_walk_per_s15 = 0.02F,
               .offset_walk_m_s05 = 0.00004F};
  return {.rig = rig, .estimator = OnboardEstimator::kKalman};
}

/// Each part by struct.pack in Python: "<B6fBBfB", then for each sensor "<6f" (place, range, peak)
/// and "<B2f", "<BB6f", "<B3f", "<B2fB3f"; then "<B8f6f" (estimator, noise, trust).
const Bytes kExampleImage = bytes_of(
    "02 9a 99 99 3e cd cc cc 3d cd cc 1c 41 0a d7 23 3c 0a d7 a3 3c 8f c2 f5 3d 01 0f 9a "
    "99 19 3e 04 "
    "0a d7 a3 3c 00 00 00 00 00 00 00 00 00 00 00 00 00 00 80 7f 00 00 00 00 00 b6 f3 fd "
    "3c a6 9b c4 bb "
    "00 00 00 00 0a d7 a3 3c 00 00 00 00 6f 12 83 3c f4 fd d4 3c 00 00 00 00 01 03 52 b8 "
    "9e 3e f4 fd d4 3c 3d 0a d7 3e 0a d7 a3 3c cd cc 0c 3f 6f 12 83 3c "
    "0a d7 a3 bc 00 00 00 00 6f 12 83 3a 6f 12 03 3b cd cc 4c 3d 6f 12 83 3b 02 17 b7 51 "
    "39 6f 12 83 3b cd cc 4c 3d "
    "00 00 00 00 0a d7 a3 bc 00 00 00 00 0a d7 a3 3b 8f c2 f5 3c 00 00 00 00 03 00 00 00 "
    "00 00 00 00 40 03 8f c2 f5 3c a6 9b 44 bc 6f 12 83 3a "
    "01 6f 12 03 3a ac c5 27 37 6f 12 83 3a ac c5 a7 37 6f 12 03 3a 00 00 00 00 00 00 00 "
    "00 17 b7 51 38 0a d7 a3 3c cd cc 4c 3d 6f 12 83 3a 6f 12 03 3b 0a d7 a3 3c ac c5 "
    "27 38");
constexpr std::size_t kEstimatorAt = 198;
constexpr std::size_t kNoiseAt = 199;
constexpr std::size_t kTrustAt = 231;

Bytes image_of(const BoardRig& rig) {
  Bytes image(kMaxRigImageBytes);
  image.resize(encode_rig(rig, image));
  return image;
}
Bytes image_of(const Rig<float>& rig) {
  return image_of(BoardRig{.rig = rig});
}

/// Whether the example is refused once one value in it is another.
template <class Value>
bool refused_with(std::size_t at, Value value) {
  Bytes image = kExampleImage;
  ByteWriter(std::span(image).subspan(at)).put(value);
  return !decode_rig(image);
}

bool refused_byte(std::size_t at, int value) {
  return refused_with(at, static_cast<std::uint8_t>(value));
}

bool never_finite(std::size_t at) {
  return refused_with(at, kNan) && refused_with(at, kInfinity) && refused_with(at, -kInfinity);
}

TEST_CASE("A rig's image is the one that Python makes", "[wire][rig_image]") {
  CHECK(image_of(example_rig()) == kExampleImage);
}

TEST_CASE("Every number of a rig comes back from its image", "[wire][rig_image]") {
  const auto decoded = decode_rig(kExampleImage);
  REQUIRE(decoded);
  CHECK(image_of(*decoded) == kExampleImage);
  CHECK(decoded->estimator == OnboardEstimator::kKalman);
  const Rig<float>* rig = &decoded->rig;
  CHECK(rig->pendulum.length_m == 0.3F);
  CHECK(rig->layout.count == 4);
  CHECK(rig->layout.position_m[2].z() == 0.001F);
  CHECK(rig->responses[0].farthest_m == kInfinity);
  CHECK(rig->responses[1].volts(0.020F) == Approx(0.42F));
  CHECK(rig->responses[2].peak_m == 0.004F);
  CHECK(rig->filter.value().order == 15);
  CHECK(rig->noise[1].volts == 0.001F);
  CHECK(rig->noise[3].gap_m == 50e-6F);
  CHECK(rig->trust.length_share == 0.02F);
  CHECK(rig->trust.offset_walk_m_s05 == 0.00004F);
}

TEST_CASE("An image of the first version is a rig for gn with the usual noise and trust",
          "[wire][rig_image]") {
  Bytes image(kExampleImage.begin(), kExampleImage.begin() + kEstimatorAt);
  image[0] = 1;
  const auto decoded = decode_rig(image);
  REQUIRE(decoded);
  CHECK(decoded->estimator == OnboardEstimator::kGaussNewton);
  CHECK(decoded->rig.responses[2].peak_m == 0.004F);
  CHECK(decoded->rig.noise[1].volts == SensorNoise<float>{}.volts);
  CHECK(decoded->rig.noise[3].gap_m == SensorNoise<float>{}.gap_m);
  CHECK(decoded->rig.trust.offset_m == FilterTrust<float>{}.offset_m);
  image.push_back(0);
  CHECK_FALSE(decode_rig(image));
}

TEST_CASE("A rig without a filter has none in its image either", "[wire][rig_image]") {
  BoardRig rig = example_rig();
  rig.rig.filter.reset();
  const Bytes image = image_of(rig);
  CHECK(image.size() == kExampleImage.size() - 5);
  CHECK_FALSE(decode_rig(image).value().rig.filter);
}

TEST_CASE("The longest image of two sensors fits what a board keeps", "[wire][rig_image]") {
  std::array<float, kMaxCurvePoints> volts{};
  std::array<float, kMaxCurvePoints> gap_m{};
  for (std::size_t i = 0; i < kMaxCurvePoints; ++i) {
    volts[i] = 0.1F * static_cast<float>(i);
    gap_m[i] = 0.05F - 0.001F * static_cast<float>(i);
  }
  Rig<float> rig = linear_rig(paper_layout<float>());
  for (Response<float>& response : rig.responses) {
    response.model = TableResponse<float>{MonotoneCubic<float>(volts, gap_m)};
  }
  const Bytes image = image_of(rig);
  CHECK(image.size() == 637);
  CHECK(decode_rig(image));
}

TEST_CASE("Eight sensors fit too where their responses are short", "[wire][rig_image]") {
  SensorLayout<float> layout = three_sensor_layout<float>();
  layout.count = kMaxSensors;
  const Bytes image = image_of(linear_rig(layout));
  CHECK(image.size() == 385);
  CHECK(decode_rig(image));
}

TEST_CASE("An image that does not fit is not written past the room", "[wire][rig_image]") {
  for (std::size_t room = 0; room < kExampleImage.size(); ++room) {
    Bytes out(kExampleImage.size(), 0xAA);
    CHECK(encode_rig(example_rig(), std::span(out).first(room)) == 0);
    CHECK(std::all_of(out.begin() + static_cast<std::ptrdiff_t>(room), out.end(),
                      [](std::uint8_t byte) { return byte == 0xAA; }));
  }
}

TEST_CASE("An image cut at any byte is refused", "[wire][rig_image]") {
  for (std::size_t size = 0; size < kExampleImage.size(); ++size) {
    CAPTURE(size);
    CHECK_FALSE(decode_rig(std::span(kExampleImage).first(size)));
  }
}

TEST_CASE("An image with a byte too many is refused", "[wire][rig_image]") {
  CHECK_FALSE(decode_rig(joined({kExampleImage, {0}})));
}

TEST_CASE("An image of another version is refused", "[wire][rig_image]") {
  CHECK(refused_byte(0, 0));
  CHECK(refused_byte(0, 1));  // which ends with the sensors
  CHECK(refused_byte(0, 3));
}

TEST_CASE("A pendulum and a disc have possible numbers", "[wire][rig_image]") {
  for (const std::size_t at : std::initializer_list<std::size_t>{1, 5, 9, 17, 21}) {
    CAPTURE(at);
    CHECK(never_finite(at));
    CHECK(refused_with(at, 0.0F));
    CHECK(refused_with(at, -1.0F));
  }
  CHECK(never_finite(13));
  CHECK(refused_with(13, -0.01F));
  CHECK_FALSE(refused_with(13, 0.0F));  // a pendulum without damping
}

TEST_CASE("A filter fits its taps", "[wire][rig_image]") {
  CHECK(refused_byte(25, 2));
  CHECK_FALSE(refused_byte(26, 63));
  CHECK(refused_byte(26, 64));
  CHECK(never_finite(27));
  CHECK(refused_with(27, 0.0F));
  CHECK(refused_with(27, 1.001F));
}

TEST_CASE("Two to eight sensors", "[wire][rig_image]") {
  for (const int count : {0, 1, 9, 255}) {
    CAPTURE(count);
    CHECK(refused_byte(31, count));
  }
}

TEST_CASE("Places are finite and tell the tilt", "[wire][rig_image]") {
  for (const std::size_t at : std::initializer_list<std::size_t>{32, 36, 40}) {
    CAPTURE(at);
    CHECK(never_finite(at));
    CHECK(refused_with(at, std::numeric_limits<float>::max()) == (at != 40));
  }
  Rig<float> in_line = linear_rig(layout_of<float>({{0.02, 0, 0}, {-0.02, 0, 0}}, 0.02));
  CHECK_FALSE(decode_rig(image_of(in_line)));
}

TEST_CASE("A range is not empty, a peak not behind the sensor", "[wire][rig_image]") {
  CHECK(never_finite(127));
  CHECK(refused_with(127, 0.05F));  // as far as the far end
  CHECK(refused_with(131, kNan));
  CHECK_FALSE(refused_with(131, kInfinity));
  CHECK(never_finite(135));
  CHECK(refused_with(135, -0.001F));
}

TEST_CASE("A response is of one of the four models", "[wire][rig_image]") {
  CHECK(refused_byte(56, 4));
  CHECK(refused_byte(56, 255));
}

TEST_CASE("A linear response has a slope", "[wire][rig_image]") {
  CHECK(never_finite(57));
  CHECK(never_finite(61));
  CHECK(refused_with(61, 0.0F));
  CHECK(refused_with(61, -0.0F));
}

TEST_CASE("A table has points enough, not too many, and never turns round", "[wire][rig_image]") {
  for (const int count : {0, 1, 33, 255}) {
    CAPTURE(count);
    CHECK(refused_byte(90, count));
  }
  for (const std::size_t at : std::initializer_list<std::size_t>{91, 95, 99, 103, 107, 111}) {
    CAPTURE(at);
    CHECK(never_finite(at));
  }
  CHECK(refused_with(99, 0.31F));    // the volts before
  CHECK(refused_with(99, 0.6F));     // beyond the volts after
  CHECK(refused_with(103, 0.026F));  // the gap before
  CHECK(refused_with(111, 0.022F));  // falls, then rises
}

TEST_CASE("A table whose points are too near or too far for a slope is refused",
          "[wire][rig_image]") {
  CHECK(refused_with(111, -std::numeric_limits<float>::max()));
  Bytes image = kExampleImage;
  ByteWriter(std::span(image).subspan(91)).put(0.0F);
  ByteWriter(std::span(image).subspan(99)).put(std::numeric_limits<float>::denorm_min());
  CHECK_FALSE(decode_rig(image));
}

TEST_CASE("An inverse square has possible numbers", "[wire][rig_image]") {
  for (const std::size_t at : std::initializer_list<std::size_t>{140, 144, 148}) {
    CAPTURE(at);
    CHECK(never_finite(at));
  }
  CHECK(refused_with(140, 0.0F));
  CHECK(refused_with(144, -0.001F));
}

TEST_CASE("A polynomial keeps falling or keeps rising over its range", "[wire][rig_image]") {
  for (const int count : {0, 1, 9, 255}) {
    CAPTURE(count);
    CHECK(refused_byte(185, count));
  }
  for (const std::size_t at : std::initializer_list<std::size_t>{177, 181, 186, 190, 194}) {
    CAPTURE(at);
    CHECK(never_finite(at));
  }
  CHECK(refused_with(181, 0.0F));    // an empty range
  CHECK(refused_with(194, 0.006F));  // the bottom at 1 V, within the range
  CHECK(refused_with(186, std::numeric_limits<float>::max()));  // rounds all to one value
}

TEST_CASE("The estimator is one of the two", "[wire][rig_image]") {
  CHECK_FALSE(refused_byte(kEstimatorAt, 0));
  CHECK(refused_byte(kEstimatorAt, 2));
  CHECK(refused_byte(kEstimatorAt, 255));
}

TEST_CASE("A noise and a trust are from 0 to what means nothing any more", "[wire][rig_image]") {
  for (std::size_t at = kNoiseAt; at < kExampleImage.size(); at += 4) {
    CAPTURE(at);
    CHECK(never_finite(at));
    CHECK(refused_with(at, -1e-6F));
    CHECK_FALSE(refused_with(at, at < kTrustAt ? 10.0F : 1000.0F));
    CHECK(refused_with(at, at < kTrustAt ? 10.001F : 1000.1F));
  }
}

TEST_CASE("No sensor is without any noise", "[wire][rig_image]") {
  CHECK_FALSE(refused_with(kNoiseAt, 0.0F));
  CHECK(refused_with(kNoiseAt + 2 * 8, 0.0F));  // whose gap has none
  CHECK_FALSE(refused_with(kTrustAt, 0.0F));
}

TEST_CASE("Something moves every pendulum a little", "[wire][rig_image]") {
  CHECK_FALSE(refused_with(kTrustAt + 2 * 4, 0.0F));
  CHECK(refused_with(kTrustAt + 3 * 4, 0.0F));  // the acceleration
}

TEST_CASE("A pendulum too short for a board's time is refused for ekf alone", "[wire][rig_image]") {
  BoardRig rig = example_rig();
  rig.rig.pendulum.length_m = 0.0099F;  // g is 9.8 m/s^2
  rig.estimator = OnboardEstimator::kGaussNewton;
  CHECK(decode_rig(image_of(rig)));
  rig.estimator = OnboardEstimator::kKalman;
  CHECK(decode_rig(image_of(rig)));
  rig.rig.pendulum.length_m = 0.0097F;
  CHECK_FALSE(decode_rig(image_of(rig)));
}

}  // namespace
}  // namespace penduline::test
