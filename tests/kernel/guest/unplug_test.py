# SPDX-License-Identifier: Apache-2.0
# Pulling the cable, in every phase of a run and at random moments.
import os
import pathlib
import random
import time
import unittest

import bench
from program import read_rows

NO_HELLO = "error: /dev/ttyACM0: found no bytes, expected a Penduline board that says Hello"


class UnplugTest(bench.BenchTest):
    def test_before_hello_the_run_fails_and_says_what_it_waited_for(self):
        board = self.start(bench.PlayedBoard)
        run = self.start(bench.Run)
        board.wait_for_question()
        bench.unplug()
        self.assertEqual(run.end(), (1, [NO_HELLO]))

    def pull_after(self, sent, count):
        """Pulls the cable when the board has sent this and so many rows of it have come; the run's end."""
        board = self.start(bench.PlayedBoard)
        run = self.start(bench.Run)
        board.wait_for_question()
        board.send(sent)
        run.wait_for_rows(count)
        time.sleep(0.1)
        bench.unplug()
        status, said = run.end()
        self.assertEqual(status, 0)
        self.assertEqual(len(run.rows()), count)
        return said

    def test_after_hello_the_run_ends_without_a_sample_and_says_so(self):
        said = self.pull_after(bench.hello(), 0)
        self.assertIn("found no sample, expected at least one", said[0])

    def test_between_two_samples_every_sample_before_is_kept(self):
        said = self.pull_after(bench.hello() + bench.samples(0, 40), 40)
        self.assertRegex(said[-1], "^info: 40 samples at 20.000 Hz, 0 lost, ")

    def test_within_a_frame_only_that_frame_is_lost(self):
        said = self.pull_after(bench.hello() + bench.samples(0, 41)[:-16], 40)
        self.assertRegex(said[-1], "^info: 40 samples at 20.000 Hz, 0 lost, ")


class PortTest(bench.BenchTest):
    def test_a_port_that_is_held_open_comes_back_under_another_number(self):
        held = os.open(bench.PORT, os.O_RDWR | os.O_NOCTTY)
        bench.unplug()
        other = pathlib.Path("/dev/ttyACM1")
        self.plug(other)
        self.assertFalse(bench.PORT.exists())
        os.close(held)
        bench.unplug()
        self.plug(bench.PORT)


class RandomTest(bench.BenchTest):
    def test_at_random_moments_every_sample_before_is_on_disk(self):
        count, seed = int(os.environ.get("UNPLUGS", "10")), int(os.environ.get("SEED", "1"))
        print(f"{count} times from seed {seed}", flush=True)
        moments = random.Random(seed)
        ended = {0: 0, 1: 0}
        for _ in range(count):
            with self.subTest(moment_s=(moment_s := moments.uniform(0, 1))):
                ended[self.pull_at(moment_s)] += 1
        print(f"ended with status 0 or 1: {ended}")

    def pull_at(self, moment_s):
        """One plugging, so many seconds of run, and the cable pulled; how the run ended."""
        if not bench.is_plugged():
            self.plug()
        board = bench.SimulatedBoard()
        recording = pathlib.Path("recording.csv")
        recording.unlink(missing_ok=True)
        run = bench.Run("--record", recording)
        try:
            time.sleep(moment_s)
            bench.unplug()
            status, said = run.end()
            self.assertEqual(board.end(), 0)
        finally:
            run.close()
            board.close()
        if status == 0:
            self.assertRegex(said[-1], f"^info: {len(run.rows())} samples")
            self.assertEqual([row["seq"] for row in read_rows(recording)],
                             [row["seq"] for row in run.rows()])
            self.assertTrue(recording.read_text(encoding="utf-8").endswith("\n"))
        else:
            self.assertEqual(len(said), 1)
            self.assertRegex(said[0], "^error: /dev/ttyACM0: ")
        return status


if __name__ == "__main__":
    unittest.main()
