// SPDX-License-Identifier: Apache-2.0
// Tests of text files: what is appended arrives in order, or the failure is reported.
#include "host/output/text_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <climits>
#include <filesystem>
#include <string>
#include <utility>

#include "tests/unit/host/fifo.hpp"
#include "tests/unit/host/small_disk.hpp"
#include "tests/unit/temporary_folder.hpp"

namespace {

using namespace penduline;
using namespace penduline::test;

TEST_CASE("A file is put whole, and nothing beside it", "[output]") {
  const TemporaryFolder folder;
  REQUIRE(put_file(folder.path("rig.toml"), "[pendulum]\n"));
  CHECK(text_of(folder.path("rig.toml")) == "[pendulum]\n");
  CHECK_FALSE(std::filesystem::exists(folder.path("rig.toml.part")));
}

TEST_CASE("A file that cannot be put leaves what was there, and nothing beside it", "[output]") {
  const TemporaryFolder folder;
  const std::string path = folder.write("rig.toml", "before");
  {
    const SmallDisk disk(4096);
    const auto put = put_file(path, std::string(5000, 'x'));
    REQUIRE_FALSE(put);
    CHECK(put.error().message == path + ".part: File too large");
  }
  CHECK(text_of(path) == "before");
  CHECK_FALSE(std::filesystem::exists(path + ".part"));
  std::filesystem::create_directory(folder.path("taken"));
  CHECK_FALSE(put_file(folder.path("taken"), "x"));
  CHECK_FALSE(std::filesystem::exists(folder.path("taken.part")));
}

TEST_CASE("A created file is empty", "[output]") {
  const TemporaryFolder folder;
  const std::string path = folder.write("out.csv", "what was there");
  REQUIRE(TextFile::create(path));
  CHECK(text_of(path).empty());
}

TEST_CASE("What is appended arrives with the flush, once, in order", "[output]") {
  const TemporaryFolder folder;
  auto file = TextFile::create(folder.path("out.csv"));
  REQUIRE(file);
  file->text() += "one\n";
  file->text() += "two\n";
  CHECK(text_of(folder.path("out.csv")).empty());
  REQUIRE(file->flush());
  file->text() += "three\n";
  REQUIRE(file->flush());
  CHECK(text_of(folder.path("out.csv")) == "one\ntwo\nthree\n");
}

TEST_CASE("A flush of nothing is no failure", "[output]") {
  const TemporaryFolder folder;
  auto file = TextFile::create(folder.path("out.csv"));
  REQUIRE(file);
  CHECK(file->flush());
}

TEST_CASE("A little text waits for more, a lot is written", "[output]") {
  const TemporaryFolder folder;
  auto file = TextFile::create(folder.path("out.csv"));
  REQUIRE(file);
  file->text() += "line\n";
  REQUIRE(file->flush_if_large());
  CHECK(text_of(folder.path("out.csv")).empty());
  file->text().append(200'000, 'x');
  REQUIRE(file->flush_if_large());
  CHECK(text_of(folder.path("out.csv")).size() == 200'005);
  CHECK(file->text().empty());
}

TEST_CASE("A piece is no more than a pipe takes whole", "[output]") {
  const Fifo fifo;
  auto file = TextFile::create(fifo.path());
  REQUIRE(file);
  file->text().assign(PIPE_BUF + 10, 'x');
  REQUIRE(file->write_piece());
  CHECK(fifo.read().size() == PIPE_BUF);
  CHECK(file->text().size() == 10);
  REQUIRE(file->write_piece());
  CHECK(fifo.read().size() == 10);
  CHECK(file->text().empty());
}

TEST_CASE("A piece that cannot be written is reported with the file's name", "[output]") {
  auto file = TextFile::create("/dev/full");
  REQUIRE(file);
  file->text() += "one\n";
  const auto written = file->write_piece();
  REQUIRE_FALSE(written);
  CHECK(written.error().message == "/dev/full: No space left on device");
}

TEST_CASE("A moved file goes on where it was", "[output]") {
  const TemporaryFolder folder;
  auto first = TextFile::create(folder.path("out.csv"));
  REQUIRE(first);
  first->text() += "one\n";
  TextFile second(std::move(*first));
  second.text() += "two\n";
  REQUIRE(second.flush());
  CHECK(text_of(folder.path("out.csv")) == "one\ntwo\n");
}

TEST_CASE("The path - is the standard output", "[output]") {
  const TemporaryFolder folder;
  const std::string path = folder.write("out.csv", "");
  const int before = ::dup(STDOUT_FILENO);
  const int opened = ::open(path.c_str(), O_WRONLY);
  REQUIRE(::dup2(opened, STDOUT_FILENO) == STDOUT_FILENO);
  ::close(opened);
  {
    auto file = TextFile::create("-");
    file->text() += "one\n";
    REQUIRE(file->flush());
  }
  // Still open after the file's end.
  REQUIRE(::write(STDOUT_FILENO, "two\n", 4) == 4);
  REQUIRE(::dup2(before, STDOUT_FILENO) == STDOUT_FILENO);
  ::close(before);
  CHECK(text_of(path) == "one\ntwo\n");
}

TEST_CASE("A full disk is reported with the file's name", "[output]") {
  auto file = TextFile::create("/dev/full");
  REQUIRE(file);
  file->text() += "one\n";
  const auto flushed = file->flush();
  REQUIRE_FALSE(flushed);
  CHECK(flushed.error().message == "/dev/full: No space left on device");
}

TEST_CASE("What could not be written is not tried again", "[output]") {
  auto file = TextFile::create("/dev/full");
  REQUIRE(file);
  file->text() += "one\n";
  REQUIRE_FALSE(file->flush());
  CHECK(file->flush());
}

TEST_CASE("A file in no folder is reported with its name", "[output]") {
  const TemporaryFolder folder;
  const auto file = TextFile::create(folder.path("none/out.csv"));
  REQUIRE_FALSE(file);
  CHECK(folder.relative(file.error().message) == "none/out.csv: No such file or directory");
}

TEST_CASE("A folder is no file to write", "[output]") {
  const TemporaryFolder folder;
  const auto file = TextFile::create(folder.path());
  REQUIRE_FALSE(file);
  CHECK(file.error().message == folder.path() + ": Is a directory");
}

}  // namespace
