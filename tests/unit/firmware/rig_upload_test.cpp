// SPDX-License-Identifier: Apache-2.0
// Tests of a rig's way from the host: repeats do no harm, and each refusal has its name.
#include "firmware/rig_upload.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdint>

#include "tests/unit/firmware/stored_rigs.hpp"

namespace penduline::test {
namespace {

using wire::Result;

constexpr std::uint16_t kSize = 100;

/// 100 bytes that differ from their neighbours.
Bytes example_image() {
  Bytes image(kSize);
  for (std::size_t i = 0; i < image.size(); ++i) {
    image[i] = static_cast<std::uint8_t>(i * 37);
  }
  return image;
}
const Bytes kImage = example_image();

wire::BeginRig begin_of(const Bytes& image) {
  return {.size_bytes = static_cast<std::uint16_t>(image.size()), .crc = wire::crc32(image)};
}

wire::RigPart part_of(const Bytes& image, std::uint16_t offset, std::uint8_t count) {
  wire::RigPart part{.offset = offset, .count = count};
  std::copy_n(image.begin() + offset, count, part.bytes.begin());
  return part;
}

/// An upload that has begun and got its first 48 bytes.
RigUpload half_an_upload() {
  RigUpload upload;
  REQUIRE(upload.begin(begin_of(kImage)) == Result::kDone);
  REQUIRE(upload.take(part_of(kImage, 0, 48)) == Result::kDone);
  return upload;
}

TEST_CASE("Pieces make the image that was announced", "[rig_upload]") {
  RigUpload upload = half_an_upload();
  CHECK(upload.take(part_of(kImage, 48, 48)) == Result::kDone);
  CHECK(upload.take(part_of(kImage, 96, 4)) == Result::kDone);
  CHECK(upload.finish() == Result::kDone);
  CHECK(std::ranges::equal(upload.image(), kImage));
}

TEST_CASE("A piece that comes again changes nothing", "[rig_upload]") {
  RigUpload upload = half_an_upload();
  CHECK(upload.take(part_of(kImage, 0, 48)) == Result::kDone);
  CHECK(upload.take(part_of(kImage, 40, 48)) == Result::kDone);
  CHECK(upload.take(part_of(kImage, 0, 10)) == Result::kDone);
  CHECK(upload.take(part_of(kImage, 88, 12)) == Result::kDone);
  CHECK(upload.take(part_of(kImage, 88, 12)) == Result::kDone);
  CHECK(upload.finish() == Result::kDone);
  CHECK(std::ranges::equal(upload.image(), kImage));
}

TEST_CASE("A piece that leaves a hole is refused, and the upload goes on", "[rig_upload]") {
  RigUpload upload = half_an_upload();
  CHECK(upload.take(part_of(kImage, 49, 48)) == Result::kIncomplete);
  CHECK(upload.finish() == Result::kIncomplete);
  CHECK(upload.take(part_of(kImage, 48, 48)) == Result::kDone);
  CHECK(upload.finish() == Result::kIncomplete);
  CHECK(upload.take(part_of(kImage, 96, 4)) == Result::kDone);
  CHECK(upload.finish() == Result::kDone);
}

TEST_CASE("A size that no image has is refused, and nothing is begun", "[rig_upload]") {
  for (const int size : {0, 1025, 65535}) {
    RigUpload upload;
    CHECK(upload.begin({.size_bytes = static_cast<std::uint16_t>(size)}) == Result::kOutOfRange);
    CHECK(upload.take({.count = 1}) == Result::kNoUpload);
  }
  CHECK(RigUpload().begin({.size_bytes = 1024}) == Result::kDone);
}

TEST_CASE("A piece beyond the image, of no bytes or of too many is refused", "[rig_upload]") {
  RigUpload upload = half_an_upload();
  const std::vector<wire::RigPart> wrong = {{.offset = 48, .count = 0},
                                            {.offset = 0, .count = 49},
                                            {.offset = 53, .count = 48},
                                            {.offset = 65535, .count = 48}};
  for (const wire::RigPart& part : wrong) {
    CHECK(upload.take(part) == Result::kOutOfRange);
  }
}

TEST_CASE("Without a beginning there is nothing to take or to finish", "[rig_upload]") {
  RigUpload upload;
  CHECK(upload.take({.count = 1}) == Result::kNoUpload);
  CHECK(upload.finish() == Result::kNoUpload);
}

TEST_CASE("An upload is over after its end, good or bad", "[rig_upload]") {
  RigUpload upload;
  REQUIRE(upload.begin(begin_of(bytes_of("01 02"))) == Result::kDone);
  REQUIRE(upload.take(part_of(bytes_of("01 03"), 0, 2)) == Result::kDone);
  CHECK(upload.finish() == Result::kDamaged);
  CHECK(upload.finish() == Result::kNoUpload);
  CHECK(upload.take({.count = 1}) == Result::kNoUpload);
}

TEST_CASE("A new beginning forgets the upload before it", "[rig_upload]") {
  RigUpload upload = half_an_upload();
  const Bytes other = bytes_of("aa bb cc");
  REQUIRE(upload.begin(begin_of(other)) == Result::kDone);
  CHECK(upload.finish() == Result::kIncomplete);
  CHECK(upload.take(part_of(other, 0, 3)) == Result::kDone);
  CHECK(upload.finish() == Result::kDone);
  CHECK(std::ranges::equal(upload.image(), other));
}

}  // namespace
}  // namespace penduline::test
