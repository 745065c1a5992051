// SPDX-License-Identifier: Apache-2.0
// Tests of a session's recorder and output: both see everything, and their failures are told.
#include <catch2/catch.hpp>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "host/output/text_file.hpp"
#include "host/session/session.hpp"
#include "tests/unit/hal/simulated_rigs.hpp"
#include "tests/unit/host/scripted_source.hpp"

namespace {

using namespace penduline;
using namespace penduline::test;

/// A session of `gn` with a recorder and an output of the test's own.
SessionResult record(ScriptedSource& source, EstimateSink& output,
                     std::function<tl::expected<void, Error>(const Sample&)> recorder) {
  const auto estimator = make_estimator({}, paper_rig(), {}).value();
  return run_session({.source = source,
                      .estimator = *estimator,
                      .output = output,
                      .recorder = std::move(recorder),
                      .warn = [](const std::string&) {}},
                     {}, StopSignal());
}

TEST_CASE("The recorder sees every sample before its estimate", "[session]") {
  ScriptedSource source({rest_sample(0), rest_sample(1), rest_sample(5), rest_sample(2)});
  KeepingSink sink;
  std::vector<std::uint64_t> recorded;
  const auto result = record(source, sink, [&](const Sample& sample) -> tl::expected<void, Error> {
    CHECK(sink.estimates.size() == recorded.size());
    recorded.push_back(sample.seq);
    return {};
  });
  CHECK_FALSE(result.error);
  CHECK(recorded == std::vector<std::uint64_t>{0, 1, 5, 2});
}

TEST_CASE("A recorder that fails ends the session with its own words", "[session]") {
  ScriptedSource source(rest_samples(5));
  KeepingSink sink;
  const auto result =
      record(source, sink, [](const Sample&) { return failure("rec.csv: the disk is full"); });
  REQUIRE(result.error);
  CHECK(result.error->message == "rec.csv: the disk is full");
  CHECK(sink.estimates.empty());
}

/// Writes a line for each estimate, at once.
class LineSink final : public EstimateSink {
 public:
  explicit LineSink(const std::string& path) : file_(TextFile::create(path).value()) {}

  tl::expected<void, Error> take(const Estimate<double>& /*estimate*/) override {
    file_.text() += "a row\n";
    return file_.flush();
  }

 private:
  TextFile file_;
};

TEST_CASE("An output that fails ends the session with the output's name, not the source's",
          "[session]") {
  ScriptedSource source(rest_samples(5));
  LineSink full("/dev/full");
  const auto result = record(source, full, {});
  REQUIRE(result.error);
  CHECK(result.error->message == "/dev/full: No space left on device");
}

}  // namespace
