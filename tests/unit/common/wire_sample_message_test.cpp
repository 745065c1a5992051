// SPDX-License-Identifier: Apache-2.0
// Tests of samples and estimates as messages.
#include "common/wire/sample_message.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <limits>

namespace penduline::test {
namespace {

using namespace wire;

Sample good_sample() {
  Sample sample{.seq = 7, .t_us = 50'000};
  sample.readings[0] = {.on = 65535, .off = 102};
  sample.readings[1] = {.on = 22876, .off = 0};
  sample.flags = flag::kSaturated | flag::kRestarted;
  return sample;
}

TEST_CASE("A sample's numbers stand in its message", "[wire]") {
  const auto message = sample_message_of(good_sample());
  REQUIRE(message);
  CHECK(message->seq == 7);
  CHECK(message->t_us == 50'000);
  CHECK(message->x_on == 65535);
  CHECK(message->x_off == 102);
  CHECK(message->y_on == 22876);
  CHECK(message->y_off == 0);
  CHECK(message->flags == 5);
}

TEST_CASE("A message's numbers stand in its sample", "[wire]") {
  const Sample sample = sample_of(SampleMessage{.seq = 7,
                                                .t_us = 50'000,
                                                .x_on = 65535,
                                                .x_off = 102,
                                                .y_on = 22876,
                                                .y_off = 1,
                                                .flags = 5});
  CHECK(sample.seq == 7);
  CHECK(sample.t_us == 50'000);
  CHECK(sample.readings[0].on == 65535);
  CHECK(sample.readings[0].off == 102);
  CHECK(sample.readings[1].on == 22876);
  CHECK(sample.readings[1].off == 1);
  CHECK(sample.missing == 0);
  CHECK(sample.flags == (flag::kSaturated | flag::kRestarted));
}

TEST_CASE("A sample that does not fit has no message", "[wire]") {
  const auto refused = [](const auto& change) {
    Sample sample = good_sample();
    change(sample);
    return !sample_message_of(sample);
  };
  CHECK(refused([](Sample& sample) { sample.missing = 0b01; }));
  CHECK(refused([](Sample& sample) { sample.missing = 0b10; }));
  CHECK(refused([](Sample& sample) { sample.t_us = -1; }));
  CHECK(refused([](Sample& sample) { sample.flags = flag::kDropout; }));
  CHECK(refused([](Sample& sample) { sample.readings[0].on = 65536; }));
  CHECK(refused([](Sample& sample) { sample.readings[0].off = -1; }));
  CHECK(refused([](Sample& sample) { sample.readings[1].on = -1; }));
  CHECK(refused([](Sample& sample) { sample.readings[1].off = 65536; }));
}

TEST_CASE("An estimate's numbers stand in its message", "[wire]") {
  Estimate<float> estimate{.t_us = -20, .seq = 9};
  estimate.attitude = {.angles = {.theta1_rad = 0.25F, .theta2_rad = -0.5F}};
  estimate.omega_rad_s = {.first = 1.5F, .second = -2.0F};
  estimate.sigma_rad = {.first = 1e-3F, .second = 2e-3F};
  estimate.residual_m = 1e-5F;
  estimate.flags = flag::kFilling;
  const AnglesMessage message = angles_message_of(estimate);
  CHECK(message.seq == 9);
  CHECK(message.t_us == -20);
  CHECK(message.theta1_rad == 0.25F);
  CHECK(message.theta2_rad == -0.5F);
  CHECK(message.residual_m == 1e-5F);
  CHECK(message.flags == flag::kFilling);
  CHECK(message.omega1_rad_s == 1.5F);
  CHECK(message.omega2_rad_s == -2.0F);
  CHECK(message.sigma1_rad == 1e-3F);
  CHECK(message.sigma2_rad == 2e-3F);
}

TEST_CASE("What an estimate does not know is NaN in its message", "[wire]") {
  const AnglesMessage message = angles_message_of(Estimate<float>{.flags = flag::kNoSolution});
  CHECK(std::isnan(message.theta1_rad));
  CHECK(std::isnan(message.theta2_rad));
  CHECK(std::isnan(message.residual_m));
  CHECK(std::isnan(message.omega1_rad_s));
  CHECK(std::isnan(message.omega2_rad_s));
  CHECK(std::isnan(message.sigma1_rad));
  CHECK(std::isnan(message.sigma2_rad));
  CHECK(message.flags == flag::kNoSolution);
}

}  // namespace
}  // namespace penduline::test
