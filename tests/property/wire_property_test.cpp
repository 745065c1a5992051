// SPDX-License-Identifier: Apache-2.0
// Properties of the wire: what goes in comes out, and noise takes only what it hits.
#include <rapidcheck/catch.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdint>
#include <optional>
#include <span>
#include <tuple>
#include <vector>

#include "common/wire/cobs.hpp"
#include "common/wire/decoder.hpp"
#include "common/wire/rig_image.hpp"
#include "tests/property/generators.hpp"
#include "tests/unit/common/wire_examples.hpp"

namespace penduline::test {
namespace {

using namespace wire;

/// Up to `most` bytes, of which many are zero, or hardly any, so that all blocks occur.
Bytes any_bytes(std::size_t most) {
  const auto size = *rc::gen::inRange<std::size_t>(0, most + 1);
  const int one_zero_in = *rc::gen::element(2, 10, 1000, 1'000'000);
  return *rc::gen::container<Bytes>(
      size, rc::gen::resize(rc::kNominalSize,
                            rc::gen::map(rc::gen::inRange(0, 255 * one_zero_in), [=](int draw) {
                              return static_cast<std::uint8_t>(draw < 255 ? 0 : 1 + draw % 255);
                            })));
}

/// A message whose fields are any bits.
template <Message Kind>
Kind any_message() {
  const Bytes payload =
      *rc::gen::container<Bytes>(kPayloadBytes<Kind>, rc::gen::arbitrary<std::uint8_t>());
  return read_message<Kind>(payload).value();
}

/// A frame of any kind of message.
Bytes any_frame() {
  const auto wanted = *rc::gen::inRange<std::size_t>(0, std::tuple_size_v<AllMessages>);
  Bytes frame;
  std::size_t index = 0;
  for_each_message([&]<Message Kind>(const Kind&) {
    if (index++ == wanted) {
      frame = frame_of(any_message<Kind>());
    }
  });
  return frame;
}

TEST_CASE("COBS leaves no zero, keeps within its bound and comes back", "[property]") {
  rc::prop("decode(encode(bytes)) == bytes", [] {
    const Bytes plain = any_bytes(1000);
    Bytes encoded(cobs_bound(plain.size()));
    encoded.resize(cobs_encode(plain, encoded));
    RC_ASSERT(!encoded.empty());
    RC_ASSERT(std::ranges::find(encoded, 0) == encoded.end());
    Bytes decoded(plain.size());
    RC_ASSERT(cobs_decode(encoded, decoded) == plain.size());
    RC_ASSERT(decoded == plain);
    // In place too.
    RC_ASSERT(cobs_decode(encoded, encoded) == plain.size());
    encoded.resize(plain.size());
    RC_ASSERT(encoded == plain);
  });
}

TEST_CASE("Any bits of any message come back, in any pieces", "[property]") {
  rc::prop("read(push(encode(message))) == message", [] {
    std::vector<Bytes> sent;
    Bytes stream;
    const auto count = *rc::gen::inRange(1, 10);
    for (int i = 0; i < count; ++i) {
      sent.push_back(any_frame());
      stream = joined({stream, sent.back()});
    }
    Decoder decoder;
    std::vector<Bytes> received;
    for (std::size_t at = 0; at < stream.size();) {
      const auto piece = std::min(*rc::gen::inRange<std::size_t>(1, 100), stream.size() - at);
      for (const KeptFrame& frame : frames_in(decoder, std::span(stream).subspan(at, piece))) {
        received.push_back(frame_of(frame.type, frame.payload));
      }
      at += piece;
    }
    RC_ASSERT(received == sent);
    RC_ASSERT(decoder.bad_frames() == 0U);
  });
}

TEST_CASE("Noise hides only the frames that it hits", "[property]") {
  rc::prop("a frame arrives if it and the zero before it are whole", [] {
    struct Sent {
      std::size_t begin;
      std::size_t end;
      Bytes frame;
    };
    std::vector<Sent> sent;
    Bytes stream = {0};
    const auto count = *rc::gen::inRange(1, 12);
    for (int i = 0; i < count; ++i) {
      const Bytes frame = any_frame();
      sent.push_back({stream.size(), stream.size() + frame.size(), frame});
      stream = joined({stream, frame});
    }
    const Bytes quiet = stream;
    for (int bursts = *rc::gen::inRange(0, 5); bursts > 0; --bursts) {
      const auto at = *rc::gen::inRange<std::size_t>(0, stream.size());
      const auto length = *rc::gen::inRange<std::size_t>(1, 100);
      for (std::size_t i = at; i < std::min(at + length, stream.size()); ++i) {
        stream[i] = *rc::gen::arbitrary<std::uint8_t>();
      }
    }
    std::vector<Bytes> whole;
    for (const Sent& one : sent) {
      const auto from = static_cast<std::ptrdiff_t>(one.begin - 1);
      const auto to = static_cast<std::ptrdiff_t>(one.end);
      if (std::equal(quiet.begin() + from, quiet.begin() + to, stream.begin() + from)) {
        whole.push_back(one.frame);
      }
    }
    std::vector<Bytes> received;
    for (const KeptFrame& frame : frames_in(stream)) {
      received.push_back(frame_of(frame.type, frame.payload));
    }
    RC_ASSERT(received == whole);
  });
}

TEST_CASE("Noise alone is bad frames, as many as it has runs between zeros", "[property]") {
  rc::prop("nothing is handed out", [] {
    const Bytes noise = joined({any_bytes(2000), {0}});
    std::uint32_t runs = 0;
    for (std::size_t i = 1; i < noise.size(); ++i) {
      runs += noise[i] == 0 && noise[i - 1] != 0 ? 1U : 0U;
    }
    Decoder decoder;
    RC_ASSERT(frames_in(decoder, noise).empty());
    RC_ASSERT(decoder.bad_frames() == runs);
  });
}

/// A rig of any layout with a linear sensor at each place, for any estimator.
BoardRig any_rig() {
  Rig<float> rig;
  rig.layout = rounded_layout(*any_layout());
  for (std::size_t i = 0; i < rig.layout.count; ++i) {
    rig.responses[i].model = LinearResponse<float>{static_cast<float>(*in_steps(0.01, 0.05)),
                                                   static_cast<float>(*in_steps(0.001, 0.01))};
  }
  if (*rc::gen::arbitrary<bool>()) {
    rig.filter = FilterDesign<float>{*rc::gen::inRange<std::size_t>(0, kMaxTaps),
                                     static_cast<float>(*in_steps(0.01, 1))};
  }
  rig.noise[1].volts = static_cast<float>(*in_steps(0, 0.01));
  rig.trust.offset_m = static_cast<float>(*in_steps(0, 0.001));
  return {
      .rig = rig,
      .estimator = *rc::gen::element(OnboardEstimator::kGaussNewton, OnboardEstimator::kKalman)};
}

Bytes image_of(const BoardRig& rig) {
  Bytes image(kMaxRigImageBytes);
  image.resize(encode_rig(rig, image));
  return image;
}

TEST_CASE("A rig's image comes back to the byte", "[property]") {
  rc::prop("encode(decode(image)) == image", [] {
    const Bytes image = image_of(any_rig());
    const auto rig = decode_rig(image);
    RC_ASSERT(rig.has_value());
    RC_ASSERT(image_of(*rig) == image);
  });
}

TEST_CASE("A damaged image is refused or a rig of its own", "[property]") {
  rc::prop("encode(decode(image)) == image where it is taken", [] {
    Bytes image = image_of(any_rig());
    for (int changes = *rc::gen::inRange(1, 4); changes > 0; --changes) {
      image[*rc::gen::inRange<std::size_t>(0, image.size())] = *rc::gen::arbitrary<std::uint8_t>();
    }
    if (const auto rig = decode_rig(image)) {
      RC_ASSERT(image_of(*rig) == image);
    }
  });
}

}  // namespace
}  // namespace penduline::test
