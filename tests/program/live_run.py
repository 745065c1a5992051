# SPDX-License-Identifier: Apache-2.0
# `penduline run` while it runs: its rows as they come, Ctrl-C, its end.
import os
import select
import signal
import subprocess
import tempfile
import time

from program import PROGRAM


class LiveRunTest:
    """What tests with runs share; to be derived from beside a unittest.TestCase."""

    def start_run(self, *options, source, rig):
        """A run of which nothing is left behind."""
        started = Run(*options, source=source, rig=rig)
        self.addCleanup(started.close)
        return started

    def finish(self, started):
        """Ctrl-C; the lines on stderr."""
        started.interrupt()
        status, said = started.end()
        self.assertEqual(status, 0, said)
        return said


class Run:
    """Started at once; its rows come as dictionaries of text."""

    def __init__(self, *options, source, rig):
        self.said = tempfile.TemporaryFile()  # a pipe that nobody reads would be full some day
        self.process = subprocess.Popen([PROGRAM, "run", source, "--rig", rig, *options],
                                        stdout=subprocess.PIPE, stderr=self.said)
        self.output = b""

    def wait_for_rows(self, count, seconds=10):
        """Waits until so many whole rows have come."""
        end = time.monotonic() + seconds
        while self.count() < count:
            left = end - time.monotonic()
            if left <= 0 or not select.select([self.process.stdout], [], [], left)[0]:
                raise AssertionError(f"found {self.count()} rows within {seconds} s, not {count}")
            more = os.read(self.process.stdout.fileno(), 65536)
            if not more:
                raise AssertionError(f"ended early: {' '.join(self.lines_said())}")
            self.output += more

    def drain(self):
        """Takes the rows that are on their way, until none comes for a while."""
        while select.select([self.process.stdout], [], [], 0.3)[0]:
            self.output += os.read(self.process.stdout.fileno(), 65536)

    def count(self):
        """How many whole rows have come."""
        return max(self.output.count(b"\n") - 1, 0)

    def rows(self):
        """All whole rows that have come."""
        head, *rows = self.output.decode().split("\n")[:-1] or [""]
        return [dict(zip(head.split(","), row.split(","))) for row in rows]

    def interrupt(self):
        self.process.send_signal(signal.SIGINT)

    def end(self, seconds=10):
        """Waits for its end; its exit status and the lines on stderr."""
        rest, _ = self.process.communicate(timeout=seconds)
        self.output += rest
        return self.process.returncode, self.lines_said()

    def lines_said(self):
        """All lines on stderr so far."""
        said = self.said.fileno()  # the program writes where the file stands: that is left alone
        return os.pread(said, os.fstat(said).st_size, 0).decode().splitlines()

    def close(self):
        self.process.kill()
        self.process.wait()
        self.process.stdout.close()
        self.said.close()
