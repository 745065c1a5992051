# SPDX-License-Identifier: Apache-2.0
# One suite for every source that needs no kernel of its own; tests/kernel has it for USB.
import subprocess
import unittest

from program import ProgramTest, run
from sim_board import BOARD, WITHOUT_PTS, SimBoard
from source_suite import RIG, SourceSuite


class SimulationTest(SourceSuite, ProgramTest):
    uri = "sim:"
    rate_hz = 200
    options = ("--rate", "200")


class RecordingTest(SourceSuite, ProgramTest):
    rate_hz = 200

    def setUp(self):
        super().setUp()
        path = self.folder / "swing.csv"
        run("simulate", "--rig", RIG, "--rate", 200, "--seconds", 20, "-o", path)
        self.uri = f"file:{path}"


@unittest.skipIf(WITHOUT_PTS, "no pseudo-terminals: /dev/pts is not mounted")
class SerialPortTest(SourceSuite, ProgramTest):
    rate_hz = 200
    options = ("--rate", "200")
    has_clock = True

    def setUp(self):
        super().setUp()
        board = SimBoard(self.folder / "port")
        self.addCleanup(board.close)
        self.uri = f"serial:{board.port}"


class PipeTest(SourceSuite, ProgramTest):
    """A board's bytes through a pipe, with no way back."""

    rate_hz = 20

    def setUp(self):
        super().setUp()
        self.board = subprocess.Popen([BOARD, "--rig", RIG, "--link", "stdout", "--seconds", "3600"],
                                      stdin=subprocess.DEVNULL, stdout=subprocess.PIPE)
        self.addCleanup(self.board.wait)
        self.addCleanup(self.board.kill)
        self.addCleanup(self.board.stdout.close)
        self.uri = f"serial:/proc/{self.board.pid}/fd/1"


del SourceSuite  # unittest would run it by itself

if __name__ == "__main__":
    unittest.main()
