# SPDX-License-Identifier: Apache-2.0
# Pulling the cable, in every phase of a run and at random moments.
import os
import pathlib
import random
import time
import unittest

import bench
from program import read_rows

RESTARTED, DROPOUT = 4, 256
NO_HELLO = "error: /dev/ttyACM0: found no bytes, expected a Penduline board that says Hello"
GONE = "info: /dev/ttyACM0: the board has gone; waiting for it"


class UnplugTest(bench.BenchTest):
    def test_before_hello_a_run_that_is_not_to_wait_fails_and_says_what_it_waited_for(self):
        board = self.start(bench.PlayedBoard)
        run = self.start(bench.Run, "--once")
        board.wait_for_question()
        bench.unplug()
        self.assertEqual(run.end(), (1, [NO_HELLO]))

    def pull_after(self, sent, count, *options):
        """Pulls the cable when the board has sent this and so many rows of it have come; the run's end."""
        board = self.start(bench.PlayedBoard)
        run = self.start(bench.Run, *options)
        board.wait_for_question()
        board.send(sent)
        run.wait_for_rows(count)
        time.sleep(0.1)
        bench.unplug()
        time.sleep(0.5)
        run.interrupt()
        status, said = run.end()
        self.assertEqual(len(run.rows()), count)
        return status, said

    def test_after_hello_the_board_is_waited_for_with_one_message(self):
        status, said = self.pull_after(bench.hello(), 0)
        self.assertEqual((status, said.count(GONE)), (0, 1))

    def test_between_two_samples_every_sample_before_is_kept(self):
        status, said = self.pull_after(bench.hello() + bench.samples(0, 40), 40)
        self.assertEqual(status, 0)
        self.assertRegex(said[-1], "^info: 40 samples at 20.000 Hz, 0 lost, ")

    def test_within_a_frame_only_that_frame_is_lost(self):
        status, said = self.pull_after(bench.hello() + bench.samples(0, 41)[:-16], 40)
        self.assertEqual(status, 0)
        self.assertRegex(said[-1], "^info: 40 samples at 20.000 Hz, 0 lost, ")

    def test_a_run_that_is_not_to_wait_fails_and_says_why(self):
        status, said = self.pull_after(bench.hello() + bench.samples(0, 40), 40, "--once")
        self.assertEqual((status, said[-1]), (1, "error: /dev/ttyACM0: the board has gone"))


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
    def test_one_run_goes_on_through_unplugs_at_random_moments(self):
        """Each time the board starts anew; all that came before is on the disk, each gap flagged."""
        count, seed = int(os.environ.get("UNPLUGS", "10")), int(os.environ.get("SEED", "1"))
        print(f"{count} times from seed {seed}", flush=True)
        moments = random.Random(seed)
        recording = pathlib.Path("recording.csv")
        run = self.start(bench.Run, "--record", recording)
        for _ in range(count):
            board = bench.SimulatedBoard()
            try:
                run.wait_for_rows(run.count() + 1)
                time.sleep(moments.uniform(0, 1))
                bench.unplug()
                self.assertEqual(board.end(), 0)
            finally:
                board.close()
            run.drain()
            self.plug()
        run.interrupt()
        status, said = run.end()
        self.assertEqual(status, 0)
        self.assertEqual(sum(line.endswith("; waiting for it") for line in said), count)
        rows = run.rows()
        self.assertEqual([row["seq"] for row in read_rows(recording)], [row["seq"] for row in rows])
        self.assertTrue(recording.read_text(encoding="utf-8").endswith("\n"))
        # A start may begin with the number that the one before would have come to: its flag tells.
        starts = {at for at in range(1, len(rows)) if int(rows[at]["flags"]) & RESTARTED}
        self.assertEqual(len(starts), count - 1)
        for at in range(1, len(rows)):
            if at in starts:
                self.assertTrue(int(rows[at]["flags"]) & DROPOUT)
            else:
                self.assertEqual(int(rows[at]["seq"]), int(rows[at - 1]["seq"]) + 1)


if __name__ == "__main__":
    unittest.main()
