# SPDX-License-Identifier: Apache-2.0
# The firmware as a process on a pseudo-terminal, under a name that stays when it starts anew.
import os
import re
import subprocess

from program import PROGRAM, RIGS

BOARD = PROGRAM.parent / "penduline-sim-board"
WITHOUT_PTS = not os.path.exists("/dev/pts/ptmx")


class SimBoard:
    """`port`, a path that does not exist, leads to the board while one runs; `time_0_s` is when the board's
    time was 0 by the host's CLOCK_MONOTONIC."""

    def __init__(self, port, *options):
        self.port = port
        self.process = subprocess.Popen([BOARD, "--rig", RIGS / "paper.toml", *options],
                                        stderr=subprocess.PIPE, text=True)
        device = re.fullmatch(r"info: link (/dev/pts/\d+)\n", self.process.stderr.readline()).group(1)
        self.time_0_s = float(re.fullmatch(r"info: time 0 at (\d+\.\d+) s of CLOCK_MONOTONIC\n",
                                           self.process.stderr.readline()).group(1))
        os.symlink(device, port)

    def close(self):
        """Pulls the plug."""
        if self.process.poll() is None:
            os.unlink(self.port)
            self.process.kill()
        self.process.wait()
        self.process.stderr.close()
