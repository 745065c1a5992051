# SPDX-License-Identifier: Apache-2.0
# What every source of `penduline run` must do, whatever brings its samples. A test for a source derives from
# SourceSuite and ProgramTest, and says what it is and at which rate it samples.
import json
import time

from live_run import LiveRunTest
from program import RIGS, read_rows, run

RIG = RIGS / "paper.toml"
ORDINARY = 4 | 2048  # restarted, filling: the first rows may have them


class SourceSuite(LiveRunTest):
    """Tests of a source that goes on for at least a second; `start` may bring its board to life."""

    uri = ""
    rate_hz = 20
    options = ()
    has_clock = False  # a board, which can be asked for its clock

    def start(self, *options):
        """A run from the source that has given ten rows."""
        started = self.start_run(*self.options, *options, source=self.uri, rig=RIG)
        started.wait_for_rows(10)
        return started

    def test_rows_follow_each_other_at_the_sources_rate(self):
        started = self.start()
        self.finish(started)
        rows = started.rows()
        first = int(rows[0]["seq"])
        self.assertEqual([int(row["seq"]) for row in rows], list(range(first, first + len(rows))))
        for row, following in zip(rows, rows[1:]):
            self.assertAlmostEqual(float(following["t_s"]) - float(row["t_s"]), 1 / self.rate_hz,
                                   delta=2e-6)
        self.assertEqual({int(row["flags"]) & ~ORDINARY for row in rows}, {0})

    def test_ctrl_c_ends_it_with_a_summary_of_every_row(self):
        started = self.start()
        said = self.finish(started)
        self.assertRegex(said[-1], f"^info: {len(started.rows())} samples at {self.rate_hz}.000 Hz, 0 lost, ")

    def test_its_recording_replays_byte_for_byte(self):
        recording = self.folder / "recording.csv"
        started = self.start("--record", recording, "--utc")
        self.finish(started)
        self.assertEqual(run("replay", recording, "--rig", RIG, "--utc").stdout,
                         started.output.decode())
        self.assertEqual(len(read_rows(recording)), len(started.rows()))

    def test_several_outputs_have_the_same_rows(self):
        csv, lines = self.folder / "rows.csv", self.folder / "more.csv"
        started = self.start("-o", "-", "-o", csv, "-o", lines)
        self.finish(started)
        self.assertEqual(csv.read_bytes(), started.output)
        self.assertEqual(lines.read_bytes(), started.output)

    def test_json_lines_have_the_columns_of_csv(self):
        head = run("run", "sim:", "--seconds", 0.1, "--fast", "--rig", RIG, "--utc").stdout.split("\n")[0]
        path = self.folder / "rows.jsonl"
        started = self.start_run(*self.options, "--format", "jsonl", "-o", path, "--utc", source=self.uri,
                                 rig=RIG)
        end = time.monotonic() + 10
        while not (path.exists() and path.read_bytes().count(b"\n") >= 10):
            self.assertLess(time.monotonic(), end, "no rows in 10 s")
            time.sleep(0.01)
        self.finish(started)
        for line in path.read_text(encoding="utf-8").splitlines():
            self.assertEqual(list(json.loads(line)), head.split(","))

    def test_rows_of_a_board_are_dated(self):
        started = self.start("--utc")
        # The angles are older than their row by the filter's delay.
        now = time.time()
        self.finish(started)
        dates = [float(row["utc_s"]) for row in started.rows() if row["utc_s"]]
        if self.has_clock:
            self.assertGreaterEqual(len(dates), len(started.rows()) - 1)
            self.assertLess(abs(now - dates[-1]), 1)
            starts = [date - float(row["t_s"]) for row, date in zip(started.rows()[-len(dates):], dates)]
            self.assertLess(max(starts) - min(starts), 1)
        else:
            self.assertEqual(dates, [])
