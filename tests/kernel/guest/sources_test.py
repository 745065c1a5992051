# SPDX-License-Identifier: Apache-2.0
# The suite that every source passes (tests/program/source_suite.py), for a board on USB.
import unittest

import bench
from program import ProgramTest
from source_suite import SourceSuite


class BoardSuite(SourceSuite, bench.BenchTest, ProgramTest):
    rate_hz = 200
    options = ("--rate", "200")
    has_clock = True

    def setUp(self):
        super().setUp()
        board = bench.SimulatedBoard()
        self.addCleanup(board.close)


class PortTest(BoardSuite):
    uri = f"serial:{bench.PORT}"


class LibusbTest(BoardSuite):
    uri = "usb:1209:0001"


class AutoTest(BoardSuite):
    uri = "auto"


del SourceSuite, BoardSuite  # unittest would run them by themselves

if __name__ == "__main__":
    unittest.main()
