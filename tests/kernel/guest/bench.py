# SPDX-License-Identifier: Apache-2.0
# A board on the guest's USB: its plug, its firmware, and `penduline run` at the other end of the cable.
import os
import pathlib
import select
import subprocess
import time
import unittest

import live_run
import wire
from program import PROGRAM, RIGS

PORT = pathlib.Path("/dev/ttyACM0")
PORT_BY_ID = pathlib.Path("/dev/serial/by-id/usb-Penduline_Penduline_0000000000000001-if00")
DEVICE = "/dev/ttyGS0"  # the firmware's end
PACKET_BYTES = 512
RIG = RIGS / "paper.toml"

HELLO, SAMPLE = wire.TYPES[0x01][0], wire.TYPES[0x02][0]


def plug():
    """Puts the cable in; the port comes a little later."""
    pathlib.Path(os.environ["UDC_FILE"]).write_text(os.environ["UDC"], encoding="utf-8")


def unplug():
    """Pulls the cable; the firmware's end hangs up, as when its power goes."""
    pathlib.Path(os.environ["UDC_FILE"]).write_text("\n", encoding="utf-8")


def is_plugged():
    return bool(pathlib.Path(os.environ["UDC_FILE"]).read_text(encoding="utf-8").strip())


def wait_until(condition, what, seconds=10, every_s=0.005):
    """Waits until `condition()` is true, which costs what asking for it every so often costs."""
    end = time.monotonic() + seconds
    while not condition():
        if time.monotonic() > end:
            raise AssertionError(f"waited {seconds} s in vain for {what}")
        time.sleep(every_s)


class BenchTest(unittest.TestCase):
    """A test that begins with a board plugged in, and leaves none."""

    def setUp(self):
        super().setUp()
        self.plug()
        self.addCleanup(lambda: is_plugged() and unplug())

    def plug(self, port=PORT):
        """Waits until nothing is left of an earlier plugging, which udevd clears away when it likes."""
        wait_until(lambda: not any(PORT.parent.glob("ttyACM*")) and not PORT_BY_ID.is_symlink(),
                   "the last port to go")
        plug()
        wait_until(port.exists, f"{port} to come")

    def start(self, what, *arguments, **options):
        """Starts a `SimulatedBoard`, `PlayedBoard` or `Run`, and leaves none of it behind."""
        started = what(*arguments, **options)
        self.addCleanup(started.close)
        return started


class SimulatedBoard:
    """The firmware as a process; it ends when the cable is pulled."""

    def __init__(self, *options):
        self.process = subprocess.Popen(
            [PROGRAM.parent / "penduline-sim-board", "--rig", RIG, "--link", DEVICE, *options],
            stderr=subprocess.PIPE, text=True)
        self.process.stderr.readline()  # it listens from now on

    def end(self):
        """Waits for its end; its exit status."""
        return self.process.wait(timeout=10)

    def close(self):
        self.process.kill()
        self.process.wait()
        self.process.stderr.close()


class PlayedBoard:
    """A board that the test plays itself, byte by byte."""

    def __init__(self):
        self.device = os.open(DEVICE, os.O_RDWR | os.O_NOCTTY)

    def wait_for_question(self):
        """Waits until the host has asked who is there: its end is open, and raw."""
        question = b""
        while wire.COMMANDS["AskHello"][0] not in question:
            if not select.select([self.device], [], [], 10)[0]:
                raise AssertionError("waited 10 s in vain for AskHello")
            question += os.read(self.device, 64)

    def send(self, data):
        os.write(self.device, data)

    def close(self):
        os.close(self.device)


def hello():
    """The frame of a board at 20 Hz."""
    return wire.encode_from_board(HELLO(
        protocol=1, board=b"played", firmware=b"0", unique_id=bytes(7) + b"\1", boot_id=1,
        tick_hz=1000000, rate_millihz=20000, full_scale_counts=65535, reference_uv=3300000,
        sensor_count=2, emitter_mode=0, window_us=556, conversions=32))


def samples(first, count):
    """The frames of so many samples, 32 bytes each."""
    return b"".join(
        wire.encode_from_board(SAMPLE(seq, 50000 * (seq + 1), 30000, 100, 30000, 100, 0))
        for seq in range(first, first + count))


class Run(live_run.Run):
    """`penduline run` on the board's port, unless told another source."""

    def __init__(self, *options, source=f"serial:{PORT}", rig=RIG):
        super().__init__(*options, source=source, rig=rig)
