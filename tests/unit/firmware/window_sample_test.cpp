// SPDX-License-Identifier: Apache-2.0
// Tests of a window's readings: means, scale, moment and flags, against values worked out by hand.
#include "firmware/window_sample.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdint>

namespace penduline::test {
namespace {

constexpr std::uint16_t kTop = 4095;

/// A window in which each burst reads one code on either channel.
Window window_of(EmitterMode mode, const std::array<std::array<std::uint16_t, 2>, 4>& codes) {
  Window window{.mode = mode};
  for (std::size_t burst = 0; burst < kBursts.size(); ++burst) {
    for (std::size_t i = 0; i < kConversionsPerBurst; ++i) {
      const std::size_t channel = (kBursts[burst].first_channel + i) % kChannels;
      window.codes[burst * kConversionsPerBurst + i] = codes[burst][channel];
    }
  }
  return window;
}

// Dark, lit, lit, dark; sensors x and y.
const Window kSwitched =
    window_of(EmitterMode::kSwitched, {{{100, 10}, {3000, 2000}, {3002, 2004}, {110, 30}}});

TEST_CASE("Lit and dark bursts are averaged apart, channel by channel", "[window_sample]") {
  const Sample sample = sample_of(kSwitched, 5, kTop, 556);
  CHECK(sample.seq == 5);
  // 3001, 105, 2002 and 20 of 4095, times 65535 / 4095 = 16.0036630..., rounded.
  CHECK(sample.readings[0].on == 48027);
  CHECK(sample.readings[0].off == 1680);
  CHECK(sample.readings[1].on == 32039);
  CHECK(sample.readings[1].off == 320);
  CHECK(sample.flags == 0);
}

TEST_CASE("Always lit there is no dark reading, all conversions being the lit one",
          "[window_sample]") {
  Window window = kSwitched;
  window.mode = EmitterMode::kLit;
  const Sample sample = sample_of(window, 0, kTop, 556);
  // (100 + 3000 + 3002 + 110) / 4 = 1553 and (10 + 2000 + 2004 + 30) / 4 = 1011.
  CHECK(sample.readings[0].on == 24854);
  CHECK(sample.readings[0].off == 0);
  CHECK(sample.readings[1].on == 16180);
  CHECK(sample.readings[1].off == 0);
}

TEST_CASE("Always dark both readings are the room's light", "[window_sample]") {
  Window window = kSwitched;
  window.mode = EmitterMode::kDark;
  const Sample sample = sample_of(window, 0, kTop, 556);
  CHECK(sample.readings[0].on == 48027);
  CHECK(sample.readings[0].off == 1680);
}

TEST_CASE("A mean is scaled exactly and rounded to the nearest", "[window_sample]") {
  CHECK(CodeSum{.sum = 0, .count = 32}.counts(kTop) == 0);
  CHECK(CodeSum{.sum = 32 * 4095, .count = 32}.counts(kTop) == 65535);
  // 1 / 32 of a code is 0.50011 counts, 1 / 33 is 0.48496.
  CHECK(CodeSum{.sum = 1, .count = 32}.counts(kTop) == 1);
  CHECK(CodeSum{.sum = 1, .count = 33}.counts(kTop) == 0);
  // A 16-bit converter loses nothing, a 10-bit one is stretched: 512 * 65535 / 1023 = 32799.53.
  CHECK(CodeSum{.sum = 64 * 12345, .count = 64}.counts(65535) == 12345);
  CHECK(CodeSum{.sum = 512, .count = 1}.counts(1023) == 32800);
  CHECK(CodeSum{}.counts(kTop) == 0);
}

TEST_CASE("The moment is the middle of the window as it really ran", "[window_sample]") {
  Window window = kSwitched;
  window.due_us = 5'000'000'000'000;
  window.late_us = 21;
  CHECK(sample_of(window, 0, kTop, 556).t_us == 5'000'000'000'299);
}

TEST_CASE("One conversion at the top flags the sample, dark or lit", "[window_sample]") {
  for (const std::size_t at : {std::size_t{0}, kConversionsPerWindow / 2,  //
                               kConversionsPerWindow - 1}) {
    Window window = kSwitched;
    window.codes[at] = kTop - 1;
    CHECK(sample_of(window, 0, kTop, 556).flags == 0);
    window.codes[at] = kTop;
    CHECK(sample_of(window, 0, kTop, 556).flags == flag::kSaturated);
  }
}

TEST_CASE("A window after lost ones is flagged", "[window_sample]") {
  Window window = kSwitched;
  window.lost_before = 1;
  CHECK(sample_of(window, 0, kTop, 556).flags == flag::kOverrun);
}

TEST_CASE("A window out of step is flagged", "[window_sample]") {
  Window window = kSwitched;
  window.out_of_step = true;
  CHECK(sample_of(window, 0, kTop, 556).flags == flag::kLate);
}

}  // namespace
}  // namespace penduline::test
