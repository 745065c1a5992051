// SPDX-License-Identifier: Apache-2.0
// Tests of a recording on disk: whole lines only, also on a disk that is full to the byte.
#include "host/recorder/recording_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <sstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "tests/unit/host/small_disk.hpp"
#include "tests/unit/temporary_folder.hpp"

namespace {

using namespace penduline;
using namespace penduline::test;

constexpr std::size_t kPage = 4096;

/// A line of so many bytes with its newline, all different.
std::string line_of(std::size_t bytes, std::size_t number) {
  std::string line = fmt::format("{:x<{}}\n", number, bytes - 1);
  REQUIRE(line.size() == bytes);
  return line;
}

/// Lines of a text that are neither blank nor a comment, each with its newline.
std::vector<std::string> rows_of(const std::string& text) {
  std::vector<std::string> rows;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    if (!line.empty() && line[0] != '#') {
      rows.push_back(line + "\n");
    }
  }
  return rows;
}

TEST_CASE("A recording begins with its head", "[recorder]") {
  const TemporaryFolder folder;
  REQUIRE(RecordingFile::create(folder.path("rec.csv"), "# head\nnames\n"));
  CHECK(text_of(folder.path("rec.csv")) == "# head\nnames\n");
}

TEST_CASE("A file that is there is neither touched nor taken", "[recorder]") {
  const TemporaryFolder folder;
  const std::string path = folder.write("rec.csv", "years of work\n");
  const auto file = RecordingFile::create(path, "# head\n");
  REQUIRE_FALSE(file);
  CHECK(file.error() == std::errc::file_exists);
  CHECK(text_of(path) == "years of work\n");
}

TEST_CASE("What was added is in the file after the write, in order", "[recorder]") {
  const TemporaryFolder folder;
  auto file = RecordingFile::create(folder.path("rec.csv"), "head\n").value();
  file.add("one\n");
  file.add("two\n");
  CHECK(text_of(folder.path("rec.csv")) == "head\n");
  CHECK(file.waiting() == "one\ntwo\n");
  REQUIRE_FALSE(file.write());
  file.add("three\n");
  REQUIRE_FALSE(file.write());
  CHECK(text_of(folder.path("rec.csv")) == "head\none\ntwo\nthree\n");
  CHECK(file.waiting().empty());
  CHECK(file.size_bytes() == 19);
}

TEST_CASE("No line crosses a page, and pages are filled with comments", "[recorder]") {
  const TemporaryFolder folder;
  const std::size_t bytes = GENERATE(2U, 37U, 64U, 4095U, 4096U);
  const std::size_t head_bytes = GENERATE(2U, 4094U, 4095U, 4096U, 5000U);
  auto file = RecordingFile::create(folder.path("rec.csv"), line_of(head_bytes, 0)).value();
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < 3 * kPage / bytes + 3; ++i) {
    lines.push_back(line_of(bytes, i % 10));
    file.add(lines.back());
    if (i % 5 == 0) {
      REQUIRE_FALSE(file.write());
    }
  }
  REQUIRE_FALSE(file.write());
  const std::string text = text_of(folder.path("rec.csv"));
  CHECK(text.size() == file.size_bytes());
  // The head is put there in one step and may be longer than a page.
  for (std::size_t end = (head_bytes + kPage - 1) / kPage * kPage; end <= text.size();
       end += kPage) {
    REQUIRE(text[end - 1] == '\n');
  }
  lines.insert(lines.begin(), line_of(head_bytes, 0));
  CHECK((rows_of(text) == lines));
}

TEST_CASE("On a disk that ends anywhere there are the lines that fit, and the others wait",
          "[recorder]") {
  const TemporaryFolder folder;
  const std::string path = folder.path("rec.csv");
  const std::vector<std::string> lines = {"one\n", "two and more\n", "3\n", "fourth\n"};
  std::string all = "head\n";
  for (const std::string& line : lines) {
    all += line;
  }
  for (std::size_t room = 5; room <= all.size(); ++room) {
    CAPTURE(room);
    ::unlink(path.c_str());
    auto file = RecordingFile::create(path, "head\n").value();
    {
      const SmallDisk disk(room);
      for (const std::string& line : lines) {
        file.add(line);
      }
      const bool all_fit = room == all.size();
      REQUIRE((file.write() == std::error_code()) == all_fit);
      const std::string whole = all.substr(0, all.rfind('\n', room - 1) + 1);
      REQUIRE(text_of(path) == whole);
      REQUIRE(whole + std::string(file.waiting()) == all);
      REQUIRE((file.write() == std::error_code()) == all_fit);
      REQUIRE(text_of(path) == whole);
    }
    REQUIRE_FALSE(file.write());
    REQUIRE(text_of(path) == all);
  }
}

TEST_CASE("A disk that is full and has room again loses nothing over many pages", "[recorder]") {
  const TemporaryFolder folder;
  const std::string path = folder.path("rec.csv");
  auto file = RecordingFile::create(path, "head\n").value();
  std::vector<std::string> lines = {"head\n"};
  std::size_t number = 0;
  for (std::size_t room = 1000; room < 5 * kPage; room += 1234) {
    const SmallDisk disk(room);
    for (int i = 0; i < 40; ++i) {
      lines.push_back(line_of(41, number++));
      file.add(lines.back());
    }
    file.write();
    const std::string text = text_of(path);
    REQUIRE(text.size() <= room);
    REQUIRE(text.ends_with('\n'));
  }
  REQUIRE_FALSE(file.write());
  CHECK((rows_of(text_of(path)) == lines));
}

TEST_CASE("kill -9 in the middle of much writing leaves whole lines", "[recorder]") {
  const TemporaryFolder folder;
  const std::string path = folder.path("rec.csv");
  for (int i = 0; i < 20; ++i) {
    ::unlink(path.c_str());
    auto file = RecordingFile::create(path, "head\n").value();
    const pid_t writer = ::fork();
    if (writer == 0) {
      // Nothing but writing, so that the kill comes in a write, as a rule.
      while (true) {
        for (std::size_t line = 0; line < 2000; ++line) {
          file.add("23,1150000,23411,102,22876,99,0\n");
        }
        if (file.write()) {
          ::_exit(1);
        }
      }
    }
    while (std::filesystem::file_size(path) < 100'000) {
      std::this_thread::sleep_for(std::chrono::microseconds(100 + 37 * i));
    }
    ::kill(writer, SIGKILL);
    int status = 0;
    REQUIRE(::waitpid(writer, &status, 0) == writer);
    REQUIRE(WIFSIGNALED(status));
    REQUIRE(text_of(path).ends_with('\n'));
  }
}

TEST_CASE("A disk without room for the head leaves no file behind", "[recorder]") {
  const TemporaryFolder folder;
  const SmallDisk disk(3);
  const auto file = RecordingFile::create(folder.path("rec.csv"), "head\n");
  REQUIRE_FALSE(file);
  CHECK(file.error() == std::errc::file_too_large);
  CHECK(std::filesystem::is_empty(folder.path()));
}

TEST_CASE("A recording is readable by all, as far as the user's mask lets it be", "[recorder]") {
  const TemporaryFolder folder;
  const mode_t before = ::umask(027);
  REQUIRE(RecordingFile::create(folder.path("rec.csv"), "head\n"));
  ::umask(before);
  struct stat status {};
  REQUIRE(::stat(folder.path("rec.csv").c_str(), &status) == 0);
  CHECK((status.st_mode & 0777U) == 0640);
}

TEST_CASE("What cannot be created is said", "[recorder]") {
  const TemporaryFolder folder;
  CHECK(RecordingFile::create(folder.path("none/rec.csv"), "head\n").error() ==
        std::errc::no_such_file_or_directory);
  CHECK(RecordingFile::create(folder.path(), "head\n").error() == std::errc::is_a_directory);
  CHECK(RecordingFile::create("/dev/full", "head\n").error() == std::errc::no_space_on_device);
}

TEST_CASE("A pipe gets the lines without fillers", "[recorder]") {
  int ends[2] = {};
  REQUIRE(::pipe(ends) == 0);
  std::string text;
  std::thread reader([&] {
    std::vector<char> bytes(kPage);
    for (ssize_t got = 0; (got = ::read(ends[0], bytes.data(), bytes.size())) > 0;) {
      text.append(bytes.data(), static_cast<std::size_t>(got));
    }
  });
  std::string expected = "head\n";
  {
    auto file = RecordingFile::create(fmt::format("/dev/fd/{}", ends[1]), "head\n").value();
    CHECK_FALSE(file.regular());
    ::close(ends[1]);
    for (std::size_t i = 0; i < 1000; ++i) {
      const std::string line = line_of(41, i);
      file.add(line);
      expected += line;
    }
    CHECK_FALSE(file.write());
    CHECK_FALSE(file.sync());
  }
  reader.join();
  ::close(ends[0]);
  CHECK((text == expected));
}

TEST_CASE("A moved recording goes on where it was", "[recorder]") {
  const TemporaryFolder folder;
  auto first = RecordingFile::create(folder.path("rec.csv"), "head\n").value();
  first.add("one\n");
  RecordingFile second(std::move(first));
  second.add("two\n");
  REQUIRE_FALSE(second.write());
  CHECK(text_of(folder.path("rec.csv")) == "head\none\ntwo\n");
}

}  // namespace
