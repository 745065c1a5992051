// SPDX-License-Identifier: Apache-2.0
// Tests of a series of recordings: when a file ends, what the next is called, what all have in
// them.
#include "host/recorder/recording_series.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "hal/replay/recording_reader.hpp"
#include "tests/unit/host/scripted_source.hpp"
#include "tests/unit/host/small_disk.hpp"
#include "tests/unit/temporary_folder.hpp"

namespace {

using namespace penduline;
using namespace penduline::test;

using Names = std::vector<std::string>;

/// 2026-11-21T07:00:03.25Z, from `date -u +%s`.
constexpr std::int64_t kSomeUtcUs = 1'795'244'403'250'000;

/// A folder for a series, and what the series warned of.
struct Place {
  TemporaryFolder folder;
  std::vector<std::string> warnings;
  std::int64_t utc_us = kSomeUtcUs;

  SeriesSettings settings(const std::string& name, RecordingLimits limits = {}) {
    return {.path = folder.path(name),
            .limits = limits,
            .warn = [this](const std::string& text) { warnings.push_back(folder.relative(text)); },
            .utc_now_us = [this] { return utc_us; }};
  }

  [[nodiscard]] Names names() const {
    Names names;
    for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
      names.push_back(entry.path().filename());
    }
    std::sort(names.begin(), names.end());
    return names;
  }

  /// The numbers of a file's samples.
  [[nodiscard]] std::vector<std::uint64_t> seqs(const std::string& name) const {
    auto reader = RecordingReader::open(folder.path(name)).value();
    std::vector<std::uint64_t> seqs;
    for (Sample sample; reader.read(sample).value();) {
      seqs.push_back(sample.seq);
    }
    return seqs;
  }
};

RecordingHeader board(std::uint32_t boot_id) {
  return {.acquisition = {},
          .board = "pico",
          .firmware = "0.1.0",
          .started = "",
          .serial = "e66058388340b32a",
          .boot_id = boot_id};
}

using Seqs = std::vector<std::uint64_t>;

TEST_CASE("Without limits a recording is one file of that name", "[recorder]") {
  Place place;
  auto series = RecordingSeries::start(place.settings("rec.csv"), board(7)).value();
  for (const Sample& sample : rest_samples(100)) {
    REQUIRE(series.add(sample));
  }
  REQUIRE(series.write());
  CHECK(place.names() == Names{"rec.csv"});
  CHECK(place.seqs("rec.csv").size() == 100);
  CHECK(series.files() == 1);
}

TEST_CASE("Rows wait until they are written", "[recorder]") {
  Place place;
  auto series = RecordingSeries::start(place.settings("rec.csv"), board(7)).value();
  REQUIRE(series.add(rest_sample(0)));
  REQUIRE(series.add(RecordingEvent{.kind = "trigger"}));
  REQUIRE(series.add(rest_sample(1)));
  CHECK(series.unwritten_samples() == 2);
  REQUIRE(series.write());
  CHECK(series.unwritten_samples() == 0);
}

TEST_CASE("A name that is taken gets a number, and its file stays as it is", "[recorder]") {
  Place place;
  REQUIRE_FALSE(place.folder.write("rec.csv", "years of work\n").empty());
  CHECK(RecordingSeries::start(place.settings("rec.csv"), board(7))->name() ==
        place.folder.path("rec-0002.csv"));
  CHECK(RecordingSeries::start(place.settings("rec.csv"), board(7))->name() ==
        place.folder.path("rec-0003.csv"));
  CHECK(text_of(place.folder.path("rec.csv")) == "years of work\n");
}

TEST_CASE("Files of so many seconds have the samples of so many seconds", "[recorder]") {
  Place place;
  auto series =
      RecordingSeries::start(place.settings("rec.csv", {.duration_us = 500'000}), board(7)).value();
  for (const Sample& sample : rest_samples(25)) {  // 20 a second
    REQUIRE(series.add(sample));
  }
  REQUIRE(series.write());
  CHECK(place.names() == Names{"rec-0001.csv", "rec-0002.csv", "rec-0003.csv"});
  CHECK(place.seqs("rec-0001.csv") == Seqs{0, 1, 2, 3, 4, 5, 6, 7, 8, 9});
  CHECK(place.seqs("rec-0002.csv").front() == 10);
  CHECK(place.seqs("rec-0003.csv") == Seqs{20, 21, 22, 23, 24});
  CHECK(series.files() == 3);
}

TEST_CASE("A board that starts anew does not end or stretch a file by its time", "[recorder]") {
  Place place;
  auto series =
      RecordingSeries::start(place.settings("rec.csv", {.duration_us = 500'000}), board(7)).value();
  for (const std::uint64_t seq : {100U, 101U, 102U, 103U, 0U, 1U, 2U, 3U, 4U, 5U, 6U, 7U}) {
    REQUIRE(series.add(rest_sample(seq)));
  }
  REQUIRE(series.write());
  // 3 periods before the restart and 7 after it are half a second.
  CHECK(place.seqs("rec-0001.csv") == Seqs{100, 101, 102, 103, 0, 1, 2, 3, 4, 5, 6});
  CHECK(place.seqs("rec-0002.csv") == Seqs{7});
}

TEST_CASE("Files of a size do not exceed it and lose nothing between them", "[recorder]") {
  Place place;
  auto series =
      RecordingSeries::start(place.settings("rec.csv", {.bytes = 10'000}), board(7)).value();
  for (const Sample& sample : rest_samples(2000)) {
    REQUIRE(series.add(sample));
  }
  REQUIRE(series.write());
  Seqs all;
  const Names names = place.names();
  for (const std::string& name : names) {
    const auto size = std::filesystem::file_size(place.folder.path(name));
    CHECK(size <= 10'000);
    CHECK((size > 9'900 || name == names.back()));
    const Seqs part = place.seqs(name);
    all.insert(all.end(), part.begin(), part.end());
  }
  CHECK(names.size() == series.files());
  REQUIRE(all.size() == 2000);
  CHECK(all.back() == 1999);
  CHECK(std::is_sorted(all.begin(), all.end()));
}

TEST_CASE("A file has one row at least, however small it should be", "[recorder]") {
  Place place;
  auto series =
      RecordingSeries::start(place.settings("rec.csv", {.bytes = 1, .duration_us = 1}), board(7))
          .value();
  for (const Sample& sample : rest_samples(3)) {
    REQUIRE(series.add(sample));
  }
  REQUIRE(series.write());
  CHECK(place.names() == Names{"rec-0001.csv", "rec-0002.csv", "rec-0003.csv"});
  CHECK(place.seqs("rec-0003.csv") == Seqs{2});
}

TEST_CASE("A later run goes on behind the numbers that are there", "[recorder]") {
  Place place;
  const SeriesSettings settings = place.settings("rec.csv", {.bytes = 10'000});
  REQUIRE(RecordingSeries::start(settings, board(7)));
  CHECK(RecordingSeries::start(settings, board(7))->name() == place.folder.path("rec-0002.csv"));
}

TEST_CASE("Dated files have numbers only where two have one date", "[recorder]") {
  Place place;
  auto series =
      RecordingSeries::start(place.settings("%H%M%S.csv", {.duration_us = 50'000}), board(7))
          .value();
  REQUIRE(series.add(rest_sample(0)));
  REQUIRE(series.add(rest_sample(1)));
  place.utc_us += 1'000'000;
  REQUIRE(series.add(rest_sample(2)));
  CHECK(place.names() == Names{"070003-0002.csv", "070003.csv", "070004.csv"});
}

TEST_CASE("Each file's header says when it began, where that is asked for", "[recorder]") {
  Place place;
  SeriesSettings settings = place.settings("rec.csv", {.duration_us = 50'000});
  settings.tell_start = true;
  auto series = RecordingSeries::start(settings, board(7)).value();
  place.utc_us += 60'000'000;
  REQUIRE(series.add(rest_sample(0)));
  REQUIRE(series.add(rest_sample(1)));
  CHECK(RecordingReader::open(place.folder.path("rec-0001.csv"))->header().started ==
        "2026-11-21T07:00:03Z");
  CHECK(RecordingReader::open(place.folder.path("rec-0002.csv"))->header().started ==
        "2026-11-21T07:01:03Z");
}

TEST_CASE("A board that has started anew gives an event, and later files its new header",
          "[recorder]") {
  Place place;
  auto series =
      RecordingSeries::start(place.settings("rec.csv", {.duration_us = 100'000}), board(7)).value();
  REQUIRE(series.add(rest_sample(100)));
  REQUIRE(series.go_on_with(board(8), kSomeUtcUs));
  REQUIRE(series.add(rest_sample(0)));
  REQUIRE(series.add(rest_sample(1)));
  REQUIRE(series.add(rest_sample(2)));
  REQUIRE(series.write());
  const std::string text = text_of(place.folder.path("rec-0001.csv"));
  CHECK(
      text.find("\n# event = { kind = \"boot\", utc = 2026-11-21T07:00:03.250000Z, boot_id = 8, "
                "serial = \"e66058388340b32a\", board = \"pico\", firmware = \"0.1.0\" }\n0,0,") !=
      std::string::npos);
  CHECK(RecordingReader::open(place.folder.path("rec-0001.csv"))->header().boot_id == 7);
  CHECK(RecordingReader::open(place.folder.path("rec-0002.csv"))->header().boot_id == 8);
}

TEST_CASE("A board that comes back as it was leaves no mark", "[recorder]") {
  Place place;
  auto series = RecordingSeries::start(place.settings("rec.csv"), board(7)).value();
  REQUIRE(series.go_on_with(board(7), kSomeUtcUs));
  REQUIRE(series.write());
  CHECK(text_of(place.folder.path("rec.csv")) == recording_head(board(7)));
}

TEST_CASE("A board that samples otherwise, or another board, has a file of its own", "[recorder]") {
  RecordingHeader other = board(7);
  SECTION("another rate") {
    other.acquisition.rate_hz = 1000;
  }
  SECTION("another board") {
    other.serial = "0000000000000001";
  }
  Place place;
  auto series = RecordingSeries::start(place.settings("rec.csv"), board(7)).value();
  REQUIRE(series.add(rest_sample(0)));
  REQUIRE(series.go_on_with(other, kSomeUtcUs));
  REQUIRE(series.add(rest_sample(0)));
  REQUIRE(series.write());
  CHECK(place.names() == Names{"rec-0002.csv", "rec.csv"});
  CHECK(place.seqs("rec.csv").size() == 1);
  const RecordingHeader read = RecordingReader::open(place.folder.path("rec-0002.csv"))->header();
  CHECK(read.acquisition.rate_hz == other.acquisition.rate_hz);
  CHECK(read.serial == other.serial);
}

TEST_CASE("A board that cannot have a file of its own yet gets it when tried again", "[recorder]") {
  Place place;
  auto series = RecordingSeries::start(place.settings("rec.csv"), board(7)).value();
  RecordingHeader faster = board(7);
  faster.acquisition.rate_hz = 1000;
  {
    const SmallDisk disk(10);
    CHECK_FALSE(series.go_on_with(faster, kSomeUtcUs));
  }
  REQUIRE(series.go_on_with(faster, kSomeUtcUs));
  CHECK(place.names() == Names{"rec-0002.csv", "rec.csv"});
}

TEST_CASE("Where the next file cannot be created the present one grows on, and that is told",
          "[recorder]") {
  Place place;
  std::filesystem::create_directory(place.folder.path("sub"));
  auto series =
      RecordingSeries::start(place.settings("sub/rec.csv", {.duration_us = 500'000}), board(7))
          .value();
  // Moved away with the folder that it is in, as by somebody who tidies up.
  std::filesystem::rename(place.folder.path("sub"), place.folder.path("old"));
  for (const Sample& sample : rest_samples(25)) {
    REQUIRE(series.add(sample));
  }
  REQUIRE(series.write());
  CHECK(place.seqs("old/rec-0001.csv").size() == 25);
  CHECK(place.warnings == Names(2,
                                "sub/rec-0001.csv: No such file or directory; recording goes on in "
                                "sub/rec-0001.csv"));
}

TEST_CASE("What a full disk does not take is taken when there is room, once", "[recorder]") {
  Place place;
  auto series = RecordingSeries::start(place.settings("rec.csv"), board(7)).value();
  std::uint64_t seq = 0;
  {
    const SmallDisk disk(4096);
    tl::expected<void, Error> failed;
    while ((failed = series.add(rest_sample(seq)))) {
      ++seq;
      REQUIRE(seq < 10'000);
    }
    CHECK(place.folder.relative(failed.error().message) == "rec.csv: File too large");
    CHECK(series.unwritten_samples() + place.seqs("rec.csv").size() == seq);
  }
  REQUIRE(series.add(rest_sample(seq)));
  REQUIRE(series.write());
  const Seqs seqs = place.seqs("rec.csv");
  REQUIRE(seqs.size() == seq + 1);
  CHECK(seqs.back() == seq);
}

TEST_CASE("What cannot be begun is said with its name", "[recorder]") {
  Place place;
  CHECK(place.folder.relative(
            RecordingSeries::start(place.settings("none/rec.csv"), board(7)).error().message) ==
        "none/rec.csv: No such file or directory");
}

TEST_CASE("A device cannot be divided", "[recorder]") {
  const std::string path = GENERATE("-", "/dev/null");
  Place place;
  SeriesSettings settings = place.settings("", {.bytes = 10'000});
  settings.path = path;
  const auto series = RecordingSeries::start(settings, board(7));
  REQUIRE_FALSE(series);
  CHECK(series.error().message.ends_with(": found no ordinary file, expected one to be divided"));
  CHECK_FALSE(std::filesystem::exists("/dev/null-0001"));
}

TEST_CASE("A device is recorded to as it is, under its own name", "[recorder]") {
  Place place;
  SeriesSettings settings = place.settings("");
  settings.path = "/dev/null";
  auto series = RecordingSeries::start(settings, board(7)).value();
  REQUIRE(series.add(rest_sample(0)));
  REQUIRE(series.write());
  CHECK(series.name() == "/dev/null");
}

}  // namespace
