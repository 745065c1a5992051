// SPDX-License-Identifier: Apache-2.0
// Tests of what one start tells the next.
#include "hal/crash_record.hpp"

#include <catch2/catch.hpp>
#include <cstring>

namespace penduline::test {
namespace {

/// Memory as it may be when power comes on.
CrashRecord of_garbage(int byte) {
  CrashRecord record;
  std::memset(static_cast<void*>(&record), byte, sizeof record);
  return record;
}

void check_empty(const CrashRecord& record) {
  CHECK(record.resets == 0);
  CHECK(record.told_cause == wire::ResetCause::kUnknown);
  CHECK(record.fault_pc == 0);
  CHECK(record.fault_line == 0);
  CHECK(wire::characters_of(record.fault_file).empty());
}

TEST_CASE("After power-on the record is empty, whatever stood in the memory", "[crash_record]") {
  for (const int byte : {0x00, 0x5a, 0xff}) {
    CrashRecord record = of_garbage(byte);
    record.begin(true);
    check_empty(record);
  }
}

TEST_CASE("Garbage is not taken for a record even where power did not go", "[crash_record]") {
  CrashRecord record = of_garbage(0xa5);
  record.begin(false);
  check_empty(record);
}

TEST_CASE("Power-on forgets the record before it", "[crash_record]") {
  CrashRecord record = of_garbage(0);
  record.begin(true);
  record.note_fault(0x10001234);
  record.begin(true);
  check_empty(record);
}

TEST_CASE("Resets are counted, and each start has another boot id", "[crash_record]") {
  CrashRecord record = of_garbage(0);
  record.begin(true);
  const std::uint32_t first = record.boot_id;
  record.begin(false);
  const std::uint32_t second = record.boot_id;
  record.begin(false);
  CHECK(record.resets == 2);
  CHECK(first != second);
  CHECK(second != record.boot_id);
  CHECK(first != record.boot_id);
  record.begin(true);  // what the memory held still makes it differ
  CHECK(record.boot_id != first);
}

TEST_CASE("A fault and a failed assertion stay for the next starts", "[crash_record]") {
  CrashRecord record = of_garbage(0);
  record.begin(true);
  record.note_fault(0x10001234);
  record.note_assertion("/home/build/firmware/application.hpp", 321);
  record.begin(false);
  record.begin(false);
  CHECK(record.told_cause == wire::ResetCause::kAssertion);
  CHECK(record.fault_pc == 0x10001234);
  CHECK(record.fault_line == 321);
  CHECK(wire::characters_of(record.fault_file) == "application.hpp");
}

TEST_CASE("A file's name is told without its folder and cut to 16 bytes", "[crash_record]") {
  CrashRecord record = of_garbage(0);
  record.begin(true);
  record.note_assertion("a_very_long_file_name.cpp", 1);
  CHECK(wire::characters_of(record.fault_file) == "a_very_long_file");
}

}  // namespace
}  // namespace penduline::test
