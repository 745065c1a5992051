// SPDX-License-Identifier: Apache-2.0
// Tests of what may stand next on a command line.
#include "host/cli/completion.hpp"

#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "host/cli/commands.hpp"
#include "host/output/output_address.hpp"
#include "host/source/source_uri.hpp"

namespace {

using namespace penduline;
using Words = std::vector<std::string>;

const SerialDevice kBoard{
    .path = "/dev/ttyACM0",
    .identity = {.vendor = kPendulineVendor, .product = kPendulineProduct, .serial_number = "E660"},
    .product = "Penduline"};
const SerialDevice kStranger{.path = "/dev/ttyUSB0", .identity = {}, .product = ""};

/// The program with its commands, and what completes these words.
struct Program {
  Program() {
    add_replay_command(app, status);
    add_run_command(app, status);
  }

  std::vector<Completion> completions(const Words& words,
                                      const std::vector<SerialDevice>& devices = {}) {
    return complete(app, words, devices);
  }

  Words words(const Words& typed, const std::vector<SerialDevice>& devices = {}) {
    Words found;
    for (const Completion& completion : completions(typed, devices)) {
      found.push_back(completion.word + (completion.files ? "FILE" : ""));
    }
    return found;
  }

  CLI::App app;
  ExitStatus status = ExitStatus::kDone;
};

TEST_CASE("Commands come first", "[completion]") {
  CHECK(Program().words({""}) == Words{"replay", "run"});
  CHECK(Program().words({"ru"}) == Words{"run"});
  CHECK(Program().words({"none", ""}).empty());
  CHECK(Program().words({}).empty());
}

TEST_CASE("A command's own commands come behind it, then their options and files", "[completion]") {
  Program program;
  add_calibrate_command(program.app, program.status);
  CHECK(program.words({"calibrate", ""}) == Words{"static", "rest", "swing", "geometry"});
  CHECK(program.words({"calibrate", "re"}) == Words{"rest"});
  CHECK(program.words({"calibrate", "rest", "--ze"}) == Words{"--zero"});
  CHECK(program.words({"calibrate", "rest", "--zero", ""}) == Words{"height", "response", "gain"});
  CHECK(program.words({"calibrate", "swing", ""}) == Words{"FILE"});
  CHECK(program.words({"calibrate", "swing", "a.csv", ""}) == Words{"FILE"});
}

TEST_CASE("A dash is followed by the options that may still come", "[completion]") {
  CHECK(Program().words({"run", "--fs"}) == Words{"--fsync"});
  CHECK(Program().words({"run", "--fsync", "10s", "--fs"}).empty());
  CHECK(Program().words({"run", "-o", "a.csv", "--out"}) == Words{"--output"});
}

TEST_CASE("An option is followed by what it takes", "[completion]") {
  CHECK(Program().words({"run", "--rig", ""}) == Words{"FILE"});
  CHECK(Program().words({"run", "--format", ""}) == Words{"csv", "jsonl"});
  CHECK(Program().words({"run", "--emitter", "l"}) == Words{"lit"});
  CHECK(Program().words({"run", "--format=j"}) == Words{"--format=jsonl"});
  CHECK(Program().words({"run", "--fsync", ""}).empty());
}

TEST_CASE("A source is asked for until there is one", "[completion]") {
  CHECK(Program().words({"run", "--strict", "--format", "csv", "si"}) == Words{"sim:"});
  CHECK(Program().words({"run", "sim:", "si"}).empty());
}

TEST_CASE("Boards that are plugged in are named", "[completion]") {
  CHECK(Program().words({"run", "auto:"}, {kStranger, kBoard}) == Words{"auto:E660"});
  CHECK(Program().words({"run", "usb:1209:0001:"}, {kBoard}) == Words{"usb:1209:0001:E660"});
}

TEST_CASE("Every source that is offered is one", "[completion]") {
  const Words sources = Program().words({"run", ""}, {kBoard});
  CHECK(sources.size() == 7);
  for (const std::string& source : sources) {
    CHECK(parse_uri(source));
  }
}

TEST_CASE("Every output that is offered is one with its address behind it", "[completion]") {
  for (const Completion& output : Program().completions({"run", "-o", ""})) {
    const bool network = output.word.size() > 1;
    const auto parsed = parse_output(output.word + (network ? "host:9870/topic" : ""));
    INFO(output.word);
    if (output.word.starts_with("udp:")) {
      CHECK(std::holds_alternative<UdpAddress>(parse_output(output.word + "host:9870").value()));
    } else if (network) {
      CHECK(std::holds_alternative<MqttAddress>(parsed.value()));
    }
  }
}

TEST_CASE("Shells get a line each, and a tab before what a file's name follows", "[completion]") {
  CHECK(text_of({{.word = "run", .help = "Turn"}, {.word = "file:", .help = "", .files = true}}) ==
        "run\tTurn\n\tfile:\n");
}

}  // namespace
