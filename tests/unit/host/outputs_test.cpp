// SPDX-License-Identifier: Apache-2.0
// Tests of several outputs as one: each gets every row, and one that fails is said once.
#include "host/output/outputs.hpp"

#include <catch2/catch.hpp>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace penduline;

using Lines = std::vector<std::string>;

/// What became of an output.
struct Fate {
  Lines events;
  std::uint64_t rows = 0;
};

/// Fails from a row on, counting those rows as dropped.
class ScriptedOutput final : public Output {
 public:
  ScriptedOutput(std::string name, std::shared_ptr<Fate> fate, std::uint64_t fails_from = 1000)
      : name_(std::move(name)), fate_(std::move(fate)), fails_from_(fails_from) {}

  [[nodiscard]] std::string name() const override { return name_; }
  tl::expected<void, Error> take(const Estimate<double>& /*estimate*/) override {
    ++fate_->rows;
    return outcome();
  }
  void close(Clock::time_point /*deadline*/) override { fate_->events.emplace_back("close"); }
  tl::expected<void, Error> finish() override {
    fate_->events.emplace_back("finish");
    return outcome();
  }
  [[nodiscard]] std::uint64_t dropped() const override {
    return fate_->rows < fails_from_ ? 0 : fate_->rows - fails_from_ + 1;
  }

 private:
  [[nodiscard]] tl::expected<void, Error> outcome() const {
    return fate_->rows < fails_from_ ? tl::expected<void, Error>()
                                     : failure(name_ + ": Broken pipe");
  }

  std::string name_;
  std::shared_ptr<Fate> fate_;
  std::uint64_t fails_from_;
};

/// Two outputs, the first of which may fail.
struct Two {
  Two(std::uint64_t fails_from, Need need) {
    outputs.add(std::make_unique<ScriptedOutput>("one", one, fails_from), need);
    outputs.add(std::make_unique<ScriptedOutput>("two", two), Need::kOptional);
  }

  /// Hands on so many rows, while that works.
  bool take(int rows) {
    for (int i = 0; i < rows; ++i) {
      if (const auto taken = outputs.take({}); !taken) {
        error = taken.error().message;
        return false;
      }
    }
    return true;
  }

  Lines finish() {
    Lines dropped;
    const auto finished = outputs.finish([&](const std::string& name, std::uint64_t rows) {
      dropped.push_back(name + " " + std::to_string(rows));
    });
    error = finished ? "" : finished.error().message;
    return dropped;
  }

  std::shared_ptr<Fate> one = std::make_shared<Fate>();
  std::shared_ptr<Fate> two = std::make_shared<Fate>();
  Lines warnings;
  std::string error;
  Outputs outputs{[this](const std::string& text) { warnings.push_back(text); }};
};

TEST_CASE("Every output gets every row", "[output]") {
  Two two(1000, Need::kOptional);
  CHECK(two.take(5));
  CHECK(two.one->rows == 5);
  CHECK(two.two->rows == 5);
  CHECK_FALSE(two.outputs.any_failed());
}

TEST_CASE("All outputs are closed before any is waited for", "[output]") {
  const auto fate = std::make_shared<Fate>();
  Outputs outputs([](const std::string&) {});
  outputs.add(std::make_unique<ScriptedOutput>("one", fate), Need::kOptional);
  outputs.add(std::make_unique<ScriptedOutput>("two", fate), Need::kOptional);
  REQUIRE(outputs.finish([](const std::string&, std::uint64_t) {}));
  CHECK(fate->events == Lines{"close", "close", "finish", "finish"});
}

TEST_CASE("An output that fails is said once, and the others go on", "[output]") {
  Two two(3, Need::kOptional);
  CHECK(two.take(5));
  CHECK(two.warnings == Lines{"one: Broken pipe; this output has ended"});
  CHECK(two.two->rows == 5);
  CHECK(two.outputs.any_failed());
  CHECK(two.finish() == Lines{"one 3"});
  CHECK(two.error.empty());
}

TEST_CASE("An essential output that fails ends the run with its own words", "[output]") {
  Two two(3, Need::kEssential);
  CHECK_FALSE(two.take(5));
  CHECK(two.error == "one: Broken pipe");
  CHECK(two.one->rows == 3);
  CHECK(two.warnings.empty());
}

TEST_CASE("The last output that fails ends the run, unless it is recorded", "[output]") {
  const bool recorded = GENERATE(false, true);
  Outputs outputs([](const std::string&) {});
  outputs.add(std::make_unique<ScriptedOutput>("one", std::make_shared<Fate>(), 1),
              Need::kOptional);
  if (recorded) {
    outputs.may_all_fail();
  }
  CHECK(outputs.take({}).has_value() == recorded);
  CHECK(outputs.any_failed());
}

TEST_CASE("An output that fails in its end is told", "[output]") {
  Outputs outputs([](const std::string&) {});
  outputs.add(std::make_unique<ScriptedOutput>("one", std::make_shared<Fate>(), 0),
              Need::kOptional);
  const auto finished = outputs.finish([](const std::string&, std::uint64_t) {});
  REQUIRE_FALSE(finished);
  CHECK(finished.error().message == "one: Broken pipe");
}

}  // namespace
