// SPDX-License-Identifier: Apache-2.0
// Tests of the processor's busy share.
#include "firmware/busy_meter.hpp"

#include <catch2/catch.hpp>

namespace penduline::test {
namespace {

TEST_CASE("What was not slept was busy, in thousandths", "[busy_meter]") {
  BusyMeter meter;
  meter.slept(100, 400);
  meter.slept(500, 950);
  CHECK(meter.permille(1000) == 250);
  CHECK(meter.permille(1000) == 250);  // to look changes nothing
}

TEST_CASE("Each period counts by itself", "[busy_meter]") {
  BusyMeter meter;
  CHECK(meter.permille(1000) == 1000);
  meter.begin(1000);
  meter.slept(1000, 2000);
  CHECK(meter.permille(2000) == 0);
  meter.begin(2000);
  CHECK(meter.permille(3000) == 1000);
}

TEST_CASE("A period of no time, and one of hours, have a share all the same", "[busy_meter]") {
  BusyMeter meter;
  meter.begin(1000);
  CHECK(meter.permille(1000) <= 1000);
  meter.slept(1000, 3'600'001'000);  // an hour
  CHECK(meter.permille(7'200'001'000) == 500);
}

TEST_CASE("A sleep that reaches over a look does not make a share below zero", "[busy_meter]") {
  BusyMeter meter;
  meter.begin(1000);
  meter.slept(500, 2000);
  CHECK(meter.permille(2000) == 0);
}

}  // namespace
}  // namespace penduline::test
