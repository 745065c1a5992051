// SPDX-License-Identifier: Apache-2.0
// Tests of handing out a recording that may still grow.
#include "host/web/recording_download.hpp"

#include <sys/stat.h>

#include <array>
#include <catch2/catch.hpp>
#include <fstream>
#include <string>

#include "tests/unit/temporary_folder.hpp"

namespace {

using namespace penduline;
using namespace penduline::test;

std::string downloaded(const std::string& path) {
  auto file = RecordingDownload::open(path);
  REQUIRE(file);
  std::string text;
  std::array<char, 1000> piece{};
  while (const std::size_t count = file->read(piece)) {
    text.append(piece.data(), count);
  }
  CHECK(text.size() == file->size_bytes());
  return text;
}

TEST_CASE("What has no newline yet is not handed out", "[web]") {
  const TemporaryFolder folder;
  const std::string path = folder.path("rec.csv");
  const auto with = [&](const std::string& text) {
    std::ofstream(path, std::ios::binary) << text;
    return downloaded(path);
  };
  CHECK(with("a\nb\n") == "a\nb\n");
  CHECK(with("a\nb") == "a\n");
  CHECK(with("a\n" + std::string(5000, 'b')) == "a\n");
  CHECK(with("ab").empty());
  CHECK(with("").empty());
}

TEST_CASE("A file is not searched for a line's end for long", "[web]") {
  const TemporaryFolder folder;
  const std::string path = folder.write("rec.csv", "a\n" + std::string(65535, 'b'));
  CHECK(downloaded(path) == "a\n");
  std::ofstream(path, std::ios::binary | std::ios::app) << 'b';
  const auto endless = RecordingDownload::open(path);
  REQUIRE_FALSE(endless);
  CHECK(folder.relative(endless.error().message) ==
        "rec.csv: found no line that ends in its last 65536 bytes, expected a recording");
}

TEST_CASE("Lines that come while it is handed out wait for the next time", "[web]") {
  const TemporaryFolder folder;
  const std::string path = folder.path("rec.csv");
  std::ofstream(path) << "a\n";
  auto file = RecordingDownload::open(path);
  REQUIRE(file);
  std::ofstream(path, std::ios::app) << "b\n";
  std::array<char, 100> piece{};
  CHECK(file->read(piece) == 2);
  CHECK(file->read(piece) == 0);
}

TEST_CASE("What is no ordinary file is refused by its name", "[web]") {
  const TemporaryFolder folder;
  const auto absent = RecordingDownload::open(folder.path("rec.csv"));
  REQUIRE_FALSE(absent);
  CHECK(folder.relative(absent.error().message) == "rec.csv: No such file or directory");
  REQUIRE(::mkfifo(folder.path("pipe").c_str(), 0600) == 0);
  CHECK_FALSE(RecordingDownload::open(folder.path("pipe")));
}

TEST_CASE("A file's name is harmless in a header", "[web]") {
  CHECK(download_name("/data/penduline-20261121T070000Z.csv") == "penduline-20261121T070000Z.csv");
  CHECK(download_name("a\"\r\nX: 1.csv") == "a___X__1.csv");
}

}  // namespace
