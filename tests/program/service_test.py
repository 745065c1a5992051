# SPDX-License-Identifier: Apache-2.0
# `penduline run` as a service: what it tells the service manager, whose socket the tests hold.
import os
import select
import signal
import socket
import subprocess
import time
import unittest

from program import PROGRAM, RIGS, ProgramTest
from sim_board import WITHOUT_PTS, SimBoard

WATCHDOG_S = 1
RECORDING_HEAD = ("# penduline_recording = 1\n# rate_hz = 20\n# full_scale_counts = 65535\n"
                  "# reference_v = 3.3\nseq,t_us,x_on,x_off,y_on,y_off,flags\n")


class ServiceTest(ProgramTest):
    def setUp(self):
        super().setUp()
        self.manager = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
        self.manager.bind(str(self.folder / "notify"))
        self.addCleanup(self.manager.close)
        self.told = []  # the lines since the last look

    def start(self, source, *options, rig=RIGS / "paper.toml"):
        process = subprocess.Popen(
            [PROGRAM, "run", source, "--rig", rig, *options], stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            env={**os.environ, "NOTIFY_SOCKET": str(self.folder / "notify"),
                 "WATCHDOG_USEC": str(WATCHDOG_S * 1000000)})
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        return process

    def listen(self, seconds):
        """Takes what is told within so many seconds; the lines."""
        end = time.monotonic() + seconds
        while select.select([self.manager], [], [], max(0, end - time.monotonic()))[0]:
            self.told += self.manager.recv(4096).decode().splitlines()
        return self.told

    def wait_for(self, line, seconds=20):
        """Takes what is told until a line begins so; that line."""
        end = time.monotonic() + seconds
        while not any(told.startswith(line) for told in self.told):
            if time.monotonic() > end:
                raise AssertionError(f"waited {seconds} s in vain for {line}, found {self.told}")
            self.listen(0.05)
        return next(told for told in self.told if told.startswith(line))

    def assert_lives(self):
        """It turns, and says so as often as it has to, also on a busy machine."""
        self.told = []
        self.assertGreaterEqual(self.listen(2 * WATCHDOG_S).count("WATCHDOG=1"), 2)

    def stop(self, process):
        """Has it end as the service manager does."""
        process.send_signal(signal.SIGTERM)
        self.assertEqual(process.wait(timeout=20), 0)
        self.wait_for("STOPPING=1")

    def test_it_is_up_and_alive_while_it_waits_for_a_board(self):
        port = self.folder / "port"
        process = self.start(f"serial:{port}")
        self.wait_for("READY=1")
        self.assertEqual(self.wait_for(f"STATUS={port}"),
                         f"STATUS={port}: No such file or directory; waiting for it (Ctrl-C ends)")
        self.assert_lives()
        self.stop(process)

    @unittest.skipIf(WITHOUT_PTS, "no pseudo-terminals: /dev/pts is not mounted")
    def test_it_is_alive_with_a_board_and_when_that_has_gone(self):
        port = self.folder / "port"
        board = SimBoard(port)
        self.addCleanup(board.close)
        process = self.start(f"serial:{port}")
        self.assertRegex(self.wait_for("STATUS=1 samples"), "STATUS=1 samples, 0 lost, 0 with angles")
        self.assert_lives()
        board.close()
        self.wait_for(f"STATUS={port}: the board has gone; waiting for it")
        self.assert_lives()
        self.stop(process)

    def test_samples_are_counted_every_few_seconds(self):
        process = self.start("sim:", "--rate", "1000")
        self.wait_for("STATUS=1 samples")
        start = time.monotonic()
        self.told = []
        self.assertRegex(self.wait_for("STATUS="), r"^STATUS=\d{4,5} samples at 1000.000 Hz, 0 lost, ")
        self.assertGreater(time.monotonic() - start, 4.5)
        self.stop(process)

    def test_waiting_for_a_samples_time_is_no_hanging(self):
        recording = self.write("rec.csv", RECORDING_HEAD + "0,0,30000,0,30000,0,0\n"
                               "1,3600000000,30000,0,30000,0,0\n")
        process = self.start(f"file:{recording}")
        self.wait_for("STATUS=1 samples")
        self.assert_lives()
        self.stop(process)

    def test_a_loop_that_hangs_says_nothing_though_the_program_lives(self):
        fifo = self.folder / "rec.csv"
        os.mkfifo(fifo)
        process = self.start(f"file:{fifo}", "--record", self.folder / "copy.csv")
        with open(fifo, "w", encoding="utf-8") as writer:
            writer.write(RECORDING_HEAD + "0,0,30000,0,30000,0,0\n")
            writer.flush()
            self.wait_for("STATUS=1 samples")
            self.listen(WATCHDOG_S)
            # Now it waits for bytes that do not come, and is right to be shot.
            self.told = []
            self.assertEqual(self.listen(2 * WATCHDOG_S), [])
            self.assertIsNone(process.poll())
            writer.write("1,50000,30000,0,30000,0,0\n")
            writer.flush()
            self.wait_for("WATCHDOG=1")
        self.assertEqual(process.wait(timeout=20), 0)
        self.wait_for("STOPPING=1")

    def test_a_rig_that_is_not_there_never_becomes_ready(self):
        process = self.start("sim:", rig=self.folder / "none.toml")
        self.assertEqual(process.wait(timeout=20), 1)
        self.assertEqual(self.listen(0), [])

    def test_a_manager_that_is_gone_changes_nothing(self):
        (self.folder / "notify").unlink()
        process = self.start("sim:", "--seconds", "0.2")
        self.assertEqual(process.wait(timeout=20), 0)


if __name__ == "__main__":
    unittest.main()
