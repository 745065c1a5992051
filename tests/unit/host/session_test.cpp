// SPDX-License-Identifier: Apache-2.0
// Tests of a session: every sample to its estimate, and every fault told once.
#include "host/session/session.hpp"

#include <catch2/catch.hpp>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "host/session/clock_exchange.hpp"
#include "tests/unit/hal/simulated_rigs.hpp"
#include "tests/unit/host/scripted_source.hpp"

namespace {

using namespace penduline;
using namespace penduline::test;

using Lines = std::vector<std::string>;

/// What a session did.
struct Run {
  std::vector<Estimate<double>> estimates;
  Lines warnings;
  std::string error;
  std::string summary;
  bool doubtful = false;
};

/// Runs a source through an estimator of the paper's rig; `gn` without a filter, so that every row
/// stands for its own sample.
Run run(ScriptedSource& source, EstimatorKind kind = EstimatorKind::kGaussNewton) {
  Rig<double> rig = paper_rig();
  if (kind == EstimatorKind::kGaussNewton) {
    rig.filter = FilterDesign<double>{.order = 0, .cutoff_of_nyquist = 1};
  }
  const auto estimator = make_estimator({.kind = kind}, rig, {}).value();
  KeepingSink sink;
  Run done;
  const SessionParts parts{.source = source,
                           .estimator = *estimator,
                           .output = sink,
                           .recorder = {},
                           .warn = [&](const std::string& text) { done.warnings.push_back(text); }};
  const SessionResult result = run_session(parts, {}, StopSignal());
  done.estimates = sink.estimates;
  done.error = result.error.value_or(Error{}).message;
  done.summary = result.summary.text();
  done.doubtful = result.doubtful;
  return done;
}

Run run(std::vector<Sample> samples, EstimatorKind kind = EstimatorKind::kGaussNewton) {
  ScriptedSource source(std::move(samples));
  return run(source, kind);
}

/// Samples at rest with these numbers.
std::vector<Sample> numbered(std::initializer_list<std::uint64_t> seqs) {
  std::vector<Sample> samples;
  for (const std::uint64_t seq : seqs) {
    samples.push_back(rest_sample(seq));
  }
  return samples;
}

TEST_CASE("A session hands one estimate on for each sample, in order", "[session]") {
  const Run done = run(rest_samples(50));
  REQUIRE(done.estimates.size() == 50);
  for (std::size_t i = 0; i < 50; ++i) {
    CHECK(done.estimates[i].seq == i);
    CHECK(done.estimates[i].attitude.has_value());
  }
  CHECK(done.summary == "50 samples at 20.000 Hz, 0 lost, 50 with angles");
}

/// The board's clock read 0 when the host's read `utc_us`.
RecordingEvent pong(std::int64_t utc_us) {
  return event_of(ClockExchange{.sent_us = 0, .t_us = 0, .received_us = 0, .utc_us = utc_us});
}

TEST_CASE("Rows are dated as soon as the board's clock is known, and anew after a restart",
          "[session]") {
  ScriptedSource source(numbered({0, 1, 2, 0, 1}));
  source.events_before[1] = {pong(1'000'000)};
  source.events_before[3] = {{.kind = "boot"}};
  source.events_before[4] = {pong(2'000'000)};
  const Run done = run(source);
  std::vector<std::optional<std::int64_t>> utc_us;
  for (const auto& estimate : done.estimates) {
    utc_us.push_back(estimate.utc_us);
  }
  CHECK(utc_us == std::vector<std::optional<std::int64_t>>{std::nullopt, 1'050'000, 1'100'000,
                                                           std::nullopt, 2'050'000});
}

TEST_CASE("Rows that come after a restart, of samples before it, have no date", "[session]") {
  ScriptedSource source(rest_samples(50));
  source.events_before[0] = {pong(1'000'000)};
  source.events_before[40] = {{.kind = "boot"}, pong(2'000'000)};
  const Run done = run(source, EstimatorKind::kPaper);
  REQUIRE(done.estimates.size() > 20);
  CHECK_FALSE(done.estimates.front().utc_us);
}

TEST_CASE("What happens beside the source is noted before the sample of its turn", "[session]") {
  ScriptedSource source(rest_samples(2));
  source.events_before[1] = {{.kind = "connected"}};
  const auto estimator = make_estimator({}, paper_rig(), {}).value();
  KeepingSink sink;
  Lines order;
  const SessionParts parts{
      .source = source,
      .estimator = *estimator,
      .output = sink,
      .recorder =
          [&](const Sample& sample) {
            order.push_back(std::to_string(sample.seq));
            return tl::expected<void, Error>();
          },
      .note = [&](const RecordingEvent& event) { order.push_back(event.kind); },
      .beside =
          [&](const SessionTurn& turn) {
            const std::string from = turn.events.empty() ? "" : " after " + turn.events[0].kind;
            return std::vector<RecordingEvent>{
                {.kind = (turn.sample ? "with sample" : "without") + from}};
          },
      .warn = [](const std::string&) {}};
  REQUIRE_FALSE(run_session(parts, {}, StopSignal()).error);
  // The reading that finds the end, and the end.
  CHECK(order == Lines{"with sample", "0", "connected", "with sample after connected", "1",
                       "without", "without"});
}

TEST_CASE("A session without faults warns of nothing", "[session]") {
  const Run done = run(rest_samples(50));
  CHECK(done.warnings.empty());
  CHECK_FALSE(done.doubtful);
}

TEST_CASE("A source without samples is doubtful", "[session]") {
  const Run done = run(rest_samples(0));
  CHECK(done.error.empty());
  CHECK(done.estimates.empty());
  CHECK(done.warnings == Lines{"script:0: found no sample, expected at least one"});
  CHECK(done.doubtful);
  CHECK(done.summary == "0 samples, 0 lost, 0 with angles");
}

TEST_CASE("Dropouts are told once, with the place, and counted", "[session]") {
  const Run done = run(numbered({0, 1, 5, 6, 9, 10}));
  CHECK(done.warnings == Lines{"script:3: seq 5, t_us 250000: samples are lost before this one, "
                               "or sampling paused [dropout]; further ones are counted"});
  CHECK(done.summary == "6 samples at 20.000 Hz, 5 lost, 6 with angles; flagged: 2 dropout");
  CHECK(done.doubtful);
}

TEST_CASE("Samples out of order are told once, with the place, and counted", "[session]") {
  const Run done = run(numbered({0, 1, 2, 1, 2, 3, 3}));
  CHECK(done.warnings == Lines{"script:4: seq 1, t_us 50000: seq or t_us went back although the "
                               "device did not restart [out_of_order]; further ones are counted"});
  CHECK(done.summary == "7 samples at 20.000 Hz, 0 lost, 7 with angles; flagged: 2 out_of_order");
  CHECK(done.doubtful);
}

TEST_CASE("A pause of the times is a dropout although seq goes on", "[session]") {
  std::vector<Sample> samples = rest_samples(5);
  samples[3].t_us += 1'000'000;
  samples[4].t_us += 1'000'000;
  const Run done = run(samples);
  CHECK(done.summary == "5 samples at 20.000 Hz, 0 lost, 5 with angles; flagged: 1 dropout");
  CHECK(done.doubtful);
}

TEST_CASE("Samples that come at another rate than the header's are told", "[session]") {
  std::vector<Sample> samples = rest_samples(5);
  for (Sample& sample : samples) {
    sample.t_us /= 2;
  }
  const Run done = run(samples);
  CHECK(done.warnings == Lines{"the samples come at 40.000 Hz, expected their nominal 20.000 Hz"});
  CHECK(done.doubtful);
}

TEST_CASE("Samples much slower than the header says are told by their own rate", "[session]") {
  std::vector<Sample> samples = rest_samples(5);
  for (Sample& sample : samples) {
    sample.t_us *= 4;
  }
  const Run done = run(samples);
  REQUIRE(done.warnings.size() == 2);
  CHECK(done.warnings[1] == "the samples come at 5.000 Hz, expected their nominal 20.000 Hz");
}

TEST_CASE("A time that goes back is out of order although seq goes on", "[session]") {
  std::vector<Sample> samples = rest_samples(3);
  samples[2].t_us = 49'999;
  CHECK(run(samples).warnings.size() == 1);
}

TEST_CASE("Missing readings are told once, with the place, and counted", "[session]") {
  std::vector<Sample> samples = rest_samples(5);
  samples[2].missing = 0b01;
  samples[3].missing = 0b10;
  const Run done = run(samples);
  CHECK(done.warnings == Lines{"script:3: seq 2, t_us 100000: the sample lacks a sensor's reading "
                               "[missing]; further ones are counted"});
  CHECK(done.summary == "5 samples at 20.000 Hz, 0 lost, 3 with angles; flagged: 2 missing");
  CHECK(done.doubtful);
}

TEST_CASE("A device that starts and a filter that fills are ordinary", "[session]") {
  std::vector<Sample> samples = rest_samples(30);
  samples[0].flags = flag::kRestarted;
  const Run done = run(samples, EstimatorKind::kPaper);
  CHECK(done.warnings.empty());
  CHECK_FALSE(done.doubtful);
  CHECK(done.summary ==
        "30 samples at 20.000 Hz, 0 lost, 2 with angles; flagged: 1 restarted, 28 filling");
}

TEST_CASE("A device that restarts midway is a dropout, and nothing of it is out of order",
          "[session]") {
  std::vector<Sample> samples = numbered({7, 8, 0, 1});
  samples[2].flags = flag::kRestarted;
  CHECK(run(samples).summary ==
        "4 samples at 20.000 Hz, 0 lost, 4 with angles; flagged: 1 restarted, 1 dropout");
}

TEST_CASE("Each kind of fault is told, though they come at once", "[session]") {
  std::vector<Sample> samples = numbered({0, 1, 5});
  samples[2].missing = 0b01;
  samples[2].flags = flag::kOverrun;
  CHECK(run(samples).warnings.size() == 3);
}

TEST_CASE("A flag of a newer device is told, too", "[session]") {
  std::vector<Sample> samples = rest_samples(3);
  samples[1].flags = 1U << 7U;
  const Run done = run(samples);
  CHECK(done.doubtful);
  REQUIRE(done.warnings.size() == 1);
  CHECK(done.warnings[0].starts_with("script:2: seq 1, t_us 50000: "));
}

TEST_CASE("An offline estimator's fault is told by its sample, not by the end of the source",
          "[session]") {
  std::vector<Sample> samples = rest_samples(40);
  samples.erase(samples.begin() + 30, samples.begin() + 33);
  CHECK(run(samples, EstimatorKind::kPaper).warnings ==
        Lines{"seq 33: samples are lost before this one, or sampling paused [dropout]; further "
              "ones are counted"});
}

TEST_CASE("What the source complains of is told and makes the session doubtful", "[session]") {
  ScriptedSource source(rest_samples(3));
  source.complaints_ = {"script:4: the last line is cut short"};
  const Run done = run(source);
  CHECK(done.warnings == source.complaints_);
  CHECK(done.doubtful);
}

TEST_CASE("A source that fails ends the session with its own words", "[session]") {
  ScriptedSource source(rest_samples(5));
  source.failure_at = 3;
  const Run done = run(source);
  CHECK(done.error == "script:3: the script fails here");
  CHECK(done.estimates.size() == 3);
}

TEST_CASE("A session that fails still tells its complaints and counts what came before",
          "[session]") {
  ScriptedSource source(rest_samples(5));
  source.failure_at = 3;
  source.complaints_ = {"script: something is odd"};
  const Run done = run(source);
  CHECK(done.warnings == source.complaints_);
  CHECK(done.summary == "3 samples at 20.000 Hz, 0 lost, 3 with angles");
}

TEST_CASE("An offline estimator answers for what came before a failure", "[session]") {
  ScriptedSource source(rest_samples(40));
  source.failure_at = 35;
  const Run done = run(source, EstimatorKind::kPaper);
  CHECK(done.error == "script:35: the script fails here");
  CHECK(done.summary == "35 samples at 20.000 Hz, 0 lost, 7 with angles; flagged: 28 filling");
}

TEST_CASE("Where the source and then the offline estimator fail, the source is told", "[session]") {
  ScriptedSource source(rest_samples(5));
  source.failure_at = 3;
  CHECK(run(source, EstimatorKind::kPaper).error == "script:3: the script fails here");
}

TEST_CASE("An estimator that fails is told with the place", "[session]") {
  std::vector<Sample> samples = rest_samples(40);
  samples[30].missing = 0b01;
  CHECK(run(samples, EstimatorKind::kPaper).error ==
        "script:31: seq 30: a reading is missing, and --estimator paper needs them all; "
        "--estimator gn does not");
}

TEST_CASE("An estimator that fails at the end is told", "[session]") {
  CHECK(run(rest_samples(3), EstimatorKind::kPaper).error ==
        "found 3 samples, --estimator paper needs more than the 28 that it drops");
}

}  // namespace
