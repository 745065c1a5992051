# SPDX-License-Identifier: Apache-2.0
# From the pendulum at the pins of the Pico's real firmware, over USB and the kernel's drivers, to angles.
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

import guest

sys.path.insert(0, str(guest.ROOT / "tests/program"))
from program import read_rows, rms_error_deg  # noqa: E402

NODE = os.environ.get("NODE", "node")
IMAGE = guest.ROOT / "build/pico/penduline-pico.uf2"
SECONDS = 6


def missing():
    if shutil.which(NODE) is None:
        return "node is not installed (Debian: nodejs)"
    if not IMAGE.exists():
        return f"{IMAGE} is not built (cmake --preset pico, cmake --build --preset pico)"
    return guest.missing()


def setUpModule():
    if (reason := missing()) is not None:
        raise unittest.SkipTest(reason)


class EndToEndTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def error_deg(self, source):
        """RMS error of the angles that the guest reads from the Pico."""
        socket, angles = self.folder / "usb", self.folder / "angles.csv"
        pico = subprocess.Popen(
            [NODE, guest.ROOT / "tests/kernel/pico/pico_on_usb.mjs", socket, self.folder],
            stderr=subprocess.PIPE, text=True)
        self.addCleanup(pico.kill)
        ending = guest.boot(
            f"tests/kernel/guest/end_to_end.py {source} {SECONDS}",
            options=("-serial", f"file:{angles}", "-device", "qemu-xhci",
                     "-chardev", f"socket,id=usb,path={socket},server=on,wait=off",
                     "-device", "usb-redir,chardev=usb"))
        self.assertEqual(ending.outcome, "passed", ending.console)
        self.assertEqual((pico.communicate(timeout=10)[1], pico.returncode), ("", 0))
        print(ending.console)
        rows = [row for row in read_rows(angles) if row["theta1_rad"]]
        self.assertGreater(len(rows), 20 * SECONDS - 40)
        return rms_error_deg(rows, read_rows(self.folder / "truth.csv"))

    def test_by_the_serial_port_the_angles_are_the_pendulums(self):
        error_deg = self.error_deg("serial:/dev/ttyACM0")
        print(f"{error_deg:.4f} degrees RMS")
        self.assertLess(error_deg, 0.3)


if __name__ == "__main__":
    unittest.main()
