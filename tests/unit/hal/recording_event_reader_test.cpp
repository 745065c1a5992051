// SPDX-License-Identifier: Apache-2.0
// Tests of what stands between a recording's rows: events, restarts of the board, joined
// recordings.
#include <catch2/catch.hpp>
#include <cstdint>
#include <string>
#include <vector>

#include "common/pipeline.hpp"
#include "tests/unit/hal/recording_text.hpp"
#include "tests/unit/hal/simulated_rigs.hpp"

namespace {

using namespace penduline;
using namespace penduline::test;

using Lines = std::vector<std::string>;

constexpr std::string_view kTrigger = "# event = { kind = \"trigger\", edge = \"rising\" }\n";
constexpr std::string_view kBoot = "# event = { kind = \"boot\", boot_id = 8 }\n";

std::string text(std::initializer_list<std::string_view> parts) {
  std::string joined;
  for (const std::string_view part : parts) {
    joined += part;
  }
  return joined;
}

TEST_CASE("Events are handed out with the row that follows them", "[recording]") {
  const ReadOut out =
      read_text(recording(text({kTrigger, "0,1,2,3,4,5,0\n1,2,3,4,5,6,0\n", kTrigger, "# a note\n",
                                kTrigger, "2,3,4,5,6,7,0\n", kTrigger})));
  CHECK(out.error.empty());
  CHECK(out.complaints.empty());
  CHECK(out.rows == Lines{"0 1 2/3 4/5 0", "1 2 3/4 5/6 0", "2 3 4/5 6/7 0"});
  const std::string trigger(kTrigger);
  CHECK(out.events == Lines{"0: " + trigger, "2: " + trigger, "2: " + trigger, "end: " + trigger});
}

TEST_CASE("An event in the header's place is a header key like any other unknown one",
          "[recording]") {
  const ReadOut out = read_text(text({kDesignHeader, kTrigger, kDesignColumns, "0,1,2,3,4,5,0\n"}));
  CHECK(out.error.empty());
  CHECK(out.rows.size() == 1);
  CHECK(out.events.empty());
}

TEST_CASE("An event of a kind that nobody knows is handed out, too", "[recording]") {
  const ReadOut out = read_text(recording("# event = { kind = \"eclipse\" }\n0,1,2,3,4,5,0\n"));
  CHECK(out.complaints.empty());
  CHECK(out.events == Lines{"0: # event = { kind = \"eclipse\" }\n"});
}

TEST_CASE("Events that cannot be read are told once and cost no row", "[recording]") {
  const ReadOut out =
      read_text(recording("# event = { kind\n0,1,2,3,4,5,0\n# event = 7\n1,2,3,4,5,6,0\n"));
  CHECK(out.error.empty());
  CHECK(out.rows.size() == 2);
  REQUIRE(out.complaints.size() == 1);
  CHECK(out.complaints[0].starts_with("rec.csv:9: found '# event = { kind' ("));
  CHECK(out.complaints[0].ends_with("such lines are skipped"));
}

TEST_CASE("The first row after a boot is restarted, whatever its flags say", "[recording]") {
  const ReadOut out = read_text(
      recording(text({"7,1,2,3,4,5,0\n", kBoot, kTrigger, "3,2,3,4,5,6,1\n4,3,4,5,6,7,0\n"})));
  CHECK(out.rows == Lines{"7 1 2/3 4/5 0", "3 2 3/4 5/6 5", "4 3 4/5 6/7 0"});
}

/// Rows of a device at rest, 20 a second, from `begin` on.
std::string rest_rows(std::uint64_t begin, std::uint64_t end) {
  std::string rows;
  for (std::uint64_t seq = begin; seq < end; ++seq) {
    rows += fmt::format("{},{},33099,0,33099,0,{}\n", seq, seq * 50'000, seq == 0 ? 4 : 0);
  }
  return rows;
}

/// The flags of the estimates that the pipeline makes of a recording.
std::vector<Flags> estimated_flags(const std::string& recorded) {
  const TemporaryFolder folder;
  auto reader = RecordingReader::open(folder.write("rec.csv", recorded)).value();
  Rig<double> rig = paper_rig();
  rig.filter = FilterDesign<double>{.order = 0, .cutoff_of_nyquist = 1};
  Pipeline<double> pipeline(rig, reader.acquisition());
  std::vector<Flags> flags;
  for (Sample sample; reader.read(sample).value();) {
    flags.push_back(pipeline.update(sample).flags);
  }
  return flags;
}

TEST_CASE("A board that starts anew in a recording is neither lost nor out of order",
          "[recording]") {
  const Flags restarted = flag::kRestarted;
  CHECK(estimated_flags(recording(rest_rows(0, 3) + std::string(kBoot) + rest_rows(0, 3))) ==
        std::vector<Flags>{restarted, 0, 0, restarted | flag::kDropout, 0, 0});
  // The host missed the first samples after the start, of which one would have been flagged.
  CHECK(estimated_flags(recording(rest_rows(10, 13) + std::string(kBoot) + rest_rows(2, 4))) ==
        std::vector<Flags>{0, 0, 0, restarted | flag::kDropout, 0});
  CHECK(estimated_flags(recording(rest_rows(10, 13) + std::string(kBoot) + rest_rows(40, 42))) ==
        std::vector<Flags>{0, 0, 0, restarted | flag::kDropout, 0});
}

TEST_CASE("Without a boot event a step back is out of order", "[recording]") {
  CHECK(estimated_flags(recording(rest_rows(10, 12) + rest_rows(2, 4))) ==
        std::vector<Flags>{0, 0, flag::kOutOfOrder, 0});
}

TEST_CASE("Files of one series that are joined read as one recording", "[recording]") {
  const std::string joined = recording(rest_rows(0, 2)) + recording(rest_rows(2, 4));
  const ReadOut out = read_text(joined);
  CHECK(out.error.empty());
  CHECK(out.complaints.empty());
  CHECK(out.rows.size() == 4);
  CHECK(estimated_flags(joined) == std::vector<Flags>{flag::kRestarted, 0, 0, 0});
}

TEST_CASE("A joined recording may have its columns in another order", "[recording]") {
  const ReadOut out = read_text(recording("0,1,2,3,4,5,0\n") + std::string(kDesignHeader) +
                                "flags,y_off,y_on,x_off,x_on,t_us,seq\n0,5,4,3,2,6,1\n");
  CHECK(out.rows == Lines{"0 1 2/3 4/5 0", "1 6 2/3 4/5 0"});
}

TEST_CASE("A joined recording of another start of the board begins with a restart", "[recording]") {
  const auto started = [](int boot_id, std::string_view row) {
    return fmt::format("{}# boot_id = {}\n{}{}", kDesignHeader, boot_id, kDesignColumns, row);
  };
  CHECK(read_text(started(1, "5,6,2,3,4,5,0\n") + started(2, "3,4,2,3,4,5,0\n")).rows ==
        Lines{"5 6 2/3 4/5 0", "3 4 2/3 4/5 4"});
  CHECK(read_text(started(1, "5,6,2,3,4,5,0\n") + started(1, "6,7,2,3,4,5,0\n")).rows ==
        Lines{"5 6 2/3 4/5 0", "6 7 2/3 4/5 0"});
}

TEST_CASE("A joined recording that is sampled otherwise is refused with its place", "[recording]") {
  std::string faster = recording("");
  faster.replace(faster.find("20.0"), 4, "40.0");
  CHECK(read_text(recording("0,1,2,3,4,5,0\n") + faster).error ==
        "rec.csv:10: found another recording, sampled otherwise (2 sensors at 40 Hz), expected 2 "
        "sensors at 20 Hz as before; replay it by itself");
}

TEST_CASE("What is wrong with a joined header is told with its own line", "[recording]") {
  std::string wrong = recording("");
  wrong.replace(wrong.find("20.0"), 4, "-1.0");
  CHECK(read_text(recording("0,1,2,3,4,5,0\n") + wrong).error ==
        "rec.csv:11: header key 'rate_hz': found -1.0, expected a rate from 0.001 to 1000000");
  CHECK(read_text(recording("0,1,2,3,4,5,0\n") + "# penduline_recording = 1\n").error ==
        "rec.csv: the file ends after line 10, in its header; expected the column names "
        "seq,t_us,...");
}

}  // namespace
