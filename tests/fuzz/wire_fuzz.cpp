// SPDX-License-Identifier: Apache-2.0
// Any bytes as a stream of frames, as COBS, as a message's payload and as a rig's image.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "common/pipeline.hpp"
#include "common/swing_tracker.hpp"
#include "common/wire/cobs.hpp"
#include "common/wire/decoder.hpp"
#include "common/wire/rig_image.hpp"
#include "common/wire/sample_message.hpp"
#include "tests/fuzz/fuzz_input.hpp"

namespace {

using namespace penduline;
using namespace penduline::fuzz;
using namespace penduline::wire;

using Input = std::span<const std::uint8_t>;

void check_cobs(Input input) {
  std::vector<std::uint8_t> encoded(cobs_bound(input.size()));
  encoded.resize(cobs_encode(input, encoded));
  require(!encoded.empty(), "the bound is room enough");
  require(std::ranges::find(encoded, 0) == encoded.end(), "what is encoded has no zero");
  std::vector<std::uint8_t> decoded(input.size());
  require(cobs_decode(encoded, decoded) == input.size() && std::ranges::equal(decoded, input),
          "what was encoded comes back");
  std::vector<std::uint8_t> unknown(input.begin(), input.end());
  const auto size = cobs_decode(unknown, unknown);
  require(!size || *size < input.size(), "decoding makes bytes fewer");
}

/// A payload that can be read is written again as it was, and a frame of it arrives.
template <Message Kind>
void check_message(Input payload) {
  const auto message = read_message<Kind>(payload);
  require(message.has_value() == (payload.size() >= kPayloadBytes<Kind>),
          "only a short payload is refused");
  if (!message) {
    return;
  }
  std::array<std::uint8_t, kMaxFrameBytes> frame{};
  const std::size_t size = encode_frame(*message, frame);
  require(size == kFrameBytes<Kind>, "a frame's size is known");
  Decoder decoder;
  int arrived = 0;
  decoder.push(std::span(frame).first(size), [&](const Frame& found) {
    require(found.type == Kind::kType, "a frame keeps its type");
    require(std::ranges::equal(found.payload, payload.first(kPayloadBytes<Kind>)),
            "a frame keeps its payload");
    ++arrived;
  });
  require(arrived == 1 && decoder.bad_frames() == 0, "a frame arrives");
}

void check_stream(Input input) {
  Decoder decoder;
  std::size_t arrived = 0;
  decoder.push(input, [&](const Frame& frame) {
    ++arrived;
    for_each_message([&]<Message Kind>(const Kind&) {
      if (frame.type == Kind::kType) {
        check_message<Kind>(frame.payload);
      }
    });
  });
  const auto zeros = static_cast<std::size_t>(std::ranges::count(input, 0));
  require(arrived + decoder.bad_frames() <= zeros, "a zero ends one frame at most");
}

template <class Estimator>
void check_estimates(Estimator estimator) {
  for (int k = 0; k < 20; ++k) {
    Sample sample{.seq = static_cast<std::uint64_t>(k), .t_us = k * 50'000};
    for (Reading& reading : sample.readings) {
      reading.on = k * 3276;
    }
    const AnglesMessage message = angles_message_of(estimator.update(sample));
    require(std::isfinite(message.theta1_rad) || message.flags != 0,
            "a row without angles says why");
  }
}

void check_rig_image(Input input) {
  const auto rig = decode_rig(input);
  if (!rig) {
    return;
  }
  constexpr std::size_t kMostAppended = 128;
  std::vector<std::uint8_t> image(input.size() + kMostAppended);
  image.resize(encode_rig(*rig, image));
  if (input.front() == kRigImageVersion) {
    require(std::ranges::equal(image, input), "a rig that is taken has one image");
  } else {
    require(image.size() > input.size() &&
                std::equal(input.begin() + 1, input.end(), image.begin() + 1),
            "an old image is the beginning of a new one");
  }
  const Acquisition<float> acquisition{.sensor_count = rig->rig.layout.count};
  check_estimates(Pipeline<float>(rig->rig, acquisition));
  if (rig->estimator == OnboardEstimator::kKalman) {
    check_estimates(SwingTracker<float>(rig->rig, acquisition));
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const Input input(data, size);
  check_cobs(input);
  check_stream(input);
  for_each_message([&]<Message Kind>(const Kind&) { check_message<Kind>(input); });
  check_rig_image(input);
  return 0;
}
