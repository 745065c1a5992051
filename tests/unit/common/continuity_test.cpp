// SPDX-License-Identifier: Apache-2.0
// Tests of continuity: every verdict on the next sample, and that a stream recovers after each.
#include "common/continuity.hpp"

#include <catch2/catch.hpp>
#include <cstdint>

namespace penduline::test {
namespace {

Sample at(std::uint64_t seq, std::int64_t t_us, Flags flags = 0) {
  return {.seq = seq, .t_us = t_us, .flags = flags};
}

/// Of a stream at 20 Hz.
Continuity at_20_hz() {
  return Continuity(Acquisition<double>{.rate_hz = 20}.longest_step_us());
}

/// Has followed samples 10 and 11, 50 ms apart.
Continuity at_eleven() {
  Continuity continuity = at_20_hz();
  continuity.follow(at(10, 500'000));
  continuity.follow(at(11, 550'000));
  return continuity;
}

void check_unbroken(const Continuity::Verdict& verdict) {
  CHECK(verdict.unbroken);
  CHECK(verdict.flags == 0);
  CHECK(verdict.lost == 0);
}

TEST_CASE("The first sample breaks nothing, whatever its number", "[continuity]") {
  Continuity continuity = at_20_hz();
  check_unbroken(continuity.follow(at(1234, 99)));
}

TEST_CASE("A first sample that says so has restarted nothing yet", "[continuity]") {
  Continuity continuity = at_20_hz();
  check_unbroken(continuity.follow(at(0, 50'000, flag::kRestarted)));
}

TEST_CASE("The next number at a later time follows on", "[continuity]") {
  check_unbroken(at_eleven().follow(at(12, 550'001)));
}

TEST_CASE("A skipped number is a dropout of one", "[continuity]") {
  const auto verdict = at_eleven().follow(at(13, 650'000));
  CHECK_FALSE(verdict.unbroken);
  CHECK(verdict.flags == flag::kDropout);
  CHECK(verdict.lost == 1);
}

TEST_CASE("A long dropout is counted in full", "[continuity]") {
  CHECK(at_eleven().follow(at(12 + 5'000'000'000, 1'000'000)).lost == 5'000'000'000);
}

TEST_CASE("A step of one and a half periods follows on, as a late sample may be", "[continuity]") {
  check_unbroken(at_eleven().follow(at(12, 550'000 + 75'000)));
}

TEST_CASE("A longer step is a dropout although no number is skipped", "[continuity]") {
  const auto verdict = at_eleven().follow(at(12, 550'000 + 75'002));
  CHECK_FALSE(verdict.unbroken);
  CHECK(verdict.flags == flag::kDropout);
  CHECK(verdict.lost == 0);
}

TEST_CASE("After a dropout the stream follows on from the new sample", "[continuity]") {
  Continuity continuity = at_eleven();
  continuity.follow(at(20, 1'000'000));
  check_unbroken(continuity.follow(at(21, 1'050'000)));
}

TEST_CASE("The same number again is out of order", "[continuity]") {
  const auto verdict = at_eleven().follow(at(11, 600'000));
  CHECK_FALSE(verdict.unbroken);
  CHECK(verdict.flags == flag::kOutOfOrder);
  CHECK(verdict.lost == 0);
}

TEST_CASE("A lower number is out of order", "[continuity]") {
  CHECK(at_eleven().follow(at(3, 600'000)).flags == flag::kOutOfOrder);
}

TEST_CASE("The next number at the same time is out of order", "[continuity]") {
  CHECK(at_eleven().follow(at(12, 550'000)).flags == flag::kOutOfOrder);
}

TEST_CASE("The next number at an earlier time is out of order", "[continuity]") {
  CHECK(at_eleven().follow(at(12, 400'000)).flags == flag::kOutOfOrder);
}

TEST_CASE("A skipped number at an earlier time is out of order, not a dropout", "[continuity]") {
  const auto verdict = at_eleven().follow(at(20, 400'000));
  CHECK(verdict.flags == flag::kOutOfOrder);
  CHECK(verdict.lost == 0);
}

TEST_CASE("After a sample out of order the stream follows on from that sample", "[continuity]") {
  Continuity continuity = at_eleven();
  continuity.follow(at(3, 150'000));
  check_unbroken(continuity.follow(at(4, 200'000)));
}

TEST_CASE("A stream that goes on past a stray number has lost only that one", "[continuity]") {
  Continuity continuity = at_eleven();
  continuity.follow(at(3, 600'000));
  const auto verdict = continuity.follow(at(13, 650'000));
  CHECK(verdict.flags == flag::kDropout);
  CHECK(verdict.lost == 1);
}

TEST_CASE("A restart is a dropout of unknown length, whatever the numbers, and not out of order",
          "[continuity]") {
  for (const Sample& sample : {at(0, 50'000, flag::kRestarted), at(12, 600'000, flag::kRestarted),
                               at(40, 2'000'000, flag::kRestarted)}) {
    const auto verdict = at_eleven().follow(sample);
    CHECK_FALSE(verdict.unbroken);
    CHECK(verdict.flags == flag::kDropout);
    CHECK(verdict.lost == 0);
  }
}

TEST_CASE("After a restart the stream follows on from its first sample", "[continuity]") {
  Continuity continuity = at_eleven();
  continuity.follow(at(0, 50'000, flag::kRestarted));
  check_unbroken(continuity.follow(at(1, 100'000)));
}

TEST_CASE("The device's other flags break nothing", "[continuity]") {
  check_unbroken(at_eleven().follow(at(12, 600'000, flag::kSaturated | flag::kOverrun)));
}

TEST_CASE("Times beyond 32 bits of microseconds follow on", "[continuity]") {
  Continuity continuity = at_20_hz();
  continuity.follow(at(85'899, 4'294'950'000));
  check_unbroken(continuity.follow(at(85'900, 4'295'000'000)));
}

}  // namespace
}  // namespace penduline::test
