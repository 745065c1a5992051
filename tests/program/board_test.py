# SPDX-License-Identifier: Apache-2.0
# `penduline run` on a board's terminal: plugged in late, reset, gone for good.
import csv
import subprocess
import time
import unittest

from live_run import LiveRunTest
from program import RIGS, ProgramTest, read_rows, run
from sim_board import BOARD, WITHOUT_PTS, SimBoard
import wire

RIG = RIGS / "paper.toml"
RESTARTED, DROPOUT = 4, 256


@unittest.skipIf(WITHOUT_PTS, "no pseudo-terminals: /dev/pts is not mounted")
class BoardTest(LiveRunTest, ProgramTest):
    def setUp(self):
        super().setUp()
        self.port = self.folder / "port"

    def plug(self, *options):
        board = SimBoard(self.port, *options)
        self.addCleanup(board.close)
        return board

    def start(self, *options):
        return self.start_run(*options, source=f"serial:{self.port}", rig=RIG)

    def wait_for_angles(self, started, since):
        """Waits for a row with angles after row `since`."""
        count = since
        while not any(row["theta1_rad"] for row in started.rows()[since:]):
            count += 1
            started.wait_for_rows(count)

    def test_the_first_angle_comes_soon_after_plugging_in(self):
        started = self.start()
        time.sleep(1)  # it has slowed down to its longest wait
        self.plug()
        plugged = time.monotonic()
        self.wait_for_angles(started, 0)
        print(f"first angle after {time.monotonic() - plugged:.2f} s")  # docs/performance.md
        self.assertLess(time.monotonic() - plugged, 10, "though the machine may be busy")
        self.finish(started)

    def test_a_run_through_a_reset_replays_byte_for_byte(self):
        recording = self.folder / "recording.csv"
        board = self.plug()
        started = self.start("--rate", "200", "--record", recording, "--utc")
        started.wait_for_rows(100)
        board.close()
        started.drain()
        before = len(started.rows())
        self.assertIn('kind = "disconnected"', recording.read_text(encoding="utf-8"))
        self.plug()
        self.wait_for_angles(started, before)
        said = self.finish(started)
        self.assertIn(f"info: {self.port}: the board has gone; waiting for it", said)
        self.assertRegex("\n".join(said), "the board is back after .* it has started anew")
        row = started.rows()[before]
        self.assertEqual(int(row["flags"]) & (RESTARTED | DROPOUT), RESTARTED | DROPOUT)
        self.assertEqual(run("replay", recording, "--rig", RIG, "--utc").stdout,
                         started.output.decode())
        self.assertEqual(len(read_rows(recording)), len(started.rows()))

    def test_a_run_that_is_not_to_wait_ends_with_the_board(self):
        board = self.plug()
        started = self.start("--once")
        started.wait_for_rows(5)
        board.close()
        status, said = started.end()
        self.assertEqual((status, said[-1]), (1, f"error: {self.port}: the board has gone"))

    def test_an_uploaded_rig_stays_on_the_board_which_finds_the_run_s_angles(self):
        store = self.folder / "store"
        board = self.plug("--store", store)
        started = self.start("--once", "--upload-rig", "ekf")
        started.wait_for_rows(5)
        self.assertIn(f"info: {self.port}: the board has stored the rig; it finds angles itself by ekf",
                      self.finish(started))
        board.close()

        stream = subprocess.run([BOARD, "--rig", RIG, "--store", store, "--link", "stdout", "--fast",
                                 "--seconds", "5"], capture_output=True, check=True).stdout
        frames = self.folder / "frames"
        frames.write_bytes(stream)
        rows = list(csv.DictReader(
            run("run", f"serial:{frames}", "--rig", RIG, "--estimator", "ekf").stdout.splitlines()))
        angles = [message for message in wire.Splitter().messages(stream)
                  if type(message).__name__ == "Angles"]
        self.assertEqual([angle.seq for angle in angles], [int(row["seq"]) for row in rows])
        for angle, row in zip(angles, rows):
            for name, within in (("theta1_rad", 1e-5), ("theta2_rad", 1e-5), ("omega1_rad_s", 1e-3),
                                 ("omega2_rad_s", 1e-3), ("sigma1_rad", 1e-5), ("sigma2_rad", 1e-5)):
                self.assertAlmostEqual(getattr(angle, name), float(row[name]), delta=within, msg=name)

    def test_a_rig_that_is_not_for_the_board_ends_the_run_in_words(self):
        self.plug()
        rig = self.write("three.toml", RIG.read_text(encoding="utf-8") + """
            [[sensor]]
            position_m = [-0.02, 0.0, 0.0]
            response = { model = "linear", gap_at_zero_m = 0.031, slope_m_per_v = -0.006 }""")
        done = run("run", f"serial:{self.port}", "--rig", rig, "--upload-rig", "gn", status=1)
        self.assertEqual(done.stderr.splitlines()[-1], f"error: {self.port}: found a rig of 3 sensors to "
                         "upload, expected 2, as many as the board reads")

    def test_a_rig_that_the_board_cannot_store_ends_the_run_in_words(self):
        self.plug("--store", self.folder / "no" / "store")
        done = run("run", f"serial:{self.port}", "--rig", RIG, "--upload-rig", "gn", status=1)
        self.assertEqual(done.stderr.splitlines()[-1],
                         f"error: {self.port}: the board refuses the rig: store_failed")

    def test_a_rig_is_uploaded_to_a_board_alone(self):
        frames = self.write("frames", "")
        done = run("run", f"serial:{frames}", "--rig", RIG, "--upload-rig", "gn", status=2)
        self.assertIn("--upload-rig: is for a board, not for its bytes in a file", done.stderr)
        done = run("run", "sim:", "--rig", RIG, "--upload-rig", "gn", status=2)
        self.assertIn("--upload-rig: is for a board only", done.stderr)

    def test_bytes_that_come_for_ever_and_are_no_boards_are_given_up(self):
        done = run("run", "serial:/dev/zero", "--once", "--rig", RIG, status=1)
        self.assertEqual(done.stderr, "error: /dev/zero: found bytes that are not its frames, expected a "
                         "Penduline board that says Hello\n")

    def test_a_second_run_is_told_who_has_the_port(self):
        self.plug()
        self.start().wait_for_rows(1)
        done = run("run", f"serial:{self.port}", "--once", "--rig", RIG, status=1)
        self.assertIn("another program has the port", done.stderr)



if __name__ == "__main__":
    unittest.main()
