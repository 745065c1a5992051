# SPDX-License-Identifier: Apache-2.0
# The Debian package's service under systemd: a board comes and goes, the program hangs, stops.
import os
import pathlib
import shutil
import signal
import subprocess
import time
import unittest

import bench
from program import RIGS

UNIT = "penduline@rig1.service"
RIG = pathlib.Path("/etc/penduline/rig1.toml")
OPTIONS = pathlib.Path("/etc/penduline/rig1.env")
RECORDINGS = pathlib.Path("/var/lib/penduline/rig1")
DYNAMIC_USERS = range(61184, 65520)  # systemd.exec(5), DynamicUser=


def systemctl(*words, status=0):
    done = subprocess.run(["systemctl", *words], capture_output=True, text=True, check=False, timeout=60)
    if done.returncode != status:
        raise AssertionError(f"systemctl {words} ended with {done.returncode}: {done.stderr}")
    return done.stdout.strip()


def shown(name):
    """What systemd says of the unit."""
    return systemctl("show", "--property", name, "--value", UNIT)


def process_status(pid):
    lines = pathlib.Path(f"/proc/{pid}/status").read_text(encoding="utf-8").splitlines()
    return dict(line.split(":\t", 1) for line in lines)


def rows():
    """How many samples the newest recording has."""
    newest = max(RECORDINGS.glob("*.csv"), default=None)
    lines = [] if newest is None else newest.read_text(encoding="utf-8").splitlines()
    return sum(line[0].isdigit() for line in lines)


def wait_until(condition, what, seconds=15):
    """Asks rarely: sleeping costs nothing here, a process does."""
    bench.wait_until(condition, what, seconds, every_s=1)


def setUpModule():
    subprocess.run(["/penduline/deb/postinst", "configure"], check=True)
    RIG.parent.mkdir(exist_ok=True)
    shutil.copy(RIGS / "paper.toml", RIG)


class ServiceTest(unittest.TestCase):
    def setUp(self):
        for recording in RECORDINGS.glob("*.csv"):
            recording.unlink()
        self.addCleanup(lambda: bench.is_plugged() and bench.unplug())
        self.addCleanup(systemctl, "stop", UNIT)

    def plug(self):
        """A board that samples."""
        board = bench.SimulatedBoard()
        self.addCleanup(board.close)
        bench.plug()

    def wait_for_rows(self, count):
        wait_until(lambda: rows() >= count, f"{count} samples in {RECORDINGS}")

    def test_it_is_up_without_a_board_and_records_the_one_that_comes(self):
        systemctl("start", UNIT)
        self.assertEqual(shown("ActiveState"), "active")
        wait_until(lambda: "waiting for it" in shown("StatusText"), "the status")
        self.plug()
        self.wait_for_rows(40)
        wait_until(lambda: " samples at 20.000 Hz, 0 lost" in shown("StatusText"), "the status")
        self.assertEqual(shown("NRestarts"), "0")

    def test_it_runs_as_a_user_of_its_own_without_rights(self):
        systemctl("start", UNIT)
        status = process_status(shown("MainPID"))
        self.assertIn(int(status["Uid"].split()[0]), DYNAMIC_USERS)
        self.assertEqual(int(status["CapBnd"], 16), 0)
        self.assertEqual((status["NoNewPrivs"], status["Seccomp"]), ("1", "2"))

    def test_stopping_closes_the_recording(self):
        systemctl("start", UNIT)
        self.plug()
        self.wait_for_rows(20)
        systemctl("stop", UNIT)
        self.assertEqual((shown("Result"), shown("ExecMainStatus")), ("success", "0"))
        self.assertTrue(max(RECORDINGS.glob("*.csv")).read_text(encoding="utf-8").endswith("\n"))

    def test_a_program_that_hangs_is_started_again_and_goes_on(self):
        systemctl("start", UNIT)
        self.plug()
        self.wait_for_rows(20)
        files, pid = len(list(RECORDINGS.glob("*.csv"))), shown("MainPID")
        os.kill(int(pid), signal.SIGSTOP)
        begin = time.monotonic()
        wait_until(lambda: shown("NRestarts") == "1", "systemd to start it again", seconds=40)
        self.assertGreater(time.monotonic() - begin, 7.5, "WatchdogSec less the last turn's age")
        wait_until(lambda: len(list(RECORDINGS.glob("*.csv"))) == files + 1, "a new recording")
        self.wait_for_rows(20)
        self.assertNotEqual(shown("MainPID"), pid)

    def test_the_device_itself_is_open_to_it_as_well(self):
        OPTIONS.write_text("PENDULINE_SOURCE=usb:1209:0001\n", encoding="utf-8")
        self.addCleanup(OPTIONS.unlink)
        self.plug()
        wait_until(bench.PORT.exists, "the port")
        systemctl("start", UNIT)
        self.wait_for_rows(20)
        self.assertFalse(bench.PORT.exists(), "the kernel's driver has let go")

    def test_a_rig_that_is_not_there_is_refused_at_once(self):
        systemctl("start", "penduline@other.service", status=1)

    def test_wrong_options_are_not_tried_again(self):
        OPTIONS.write_text("PENDULINE_OPTIONS=--no-such-option\n", encoding="utf-8")
        self.addCleanup(OPTIONS.unlink)
        systemctl("start", UNIT, status=1)
        self.assertEqual((shown("ActiveState"), shown("ExecMainStatus")), ("failed", "2"))
        systemctl("reset-failed", UNIT)


if __name__ == "__main__":
    unittest.main()
