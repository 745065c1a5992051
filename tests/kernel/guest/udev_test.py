# SPDX-License-Identifier: Apache-2.0
# Penduline's udev rules under the real udevd: names, groups and what keeps others away.
import grp
import os
import pathlib
import stat
import subprocess
import unittest

import bench

NAME = pathlib.Path("/dev/penduline-0000000000000001")


def group_and_mode(path):
    found = path.stat()
    return grp.getgrgid(found.st_gid).gr_name, stat.S_IMODE(found.st_mode)


def properties(path):
    """What udev knows of a device, once it has said all."""
    subprocess.run(["udevadm", "settle"], check=True)
    told = subprocess.run(["udevadm", "info", "--query=property", path], capture_output=True, text=True,
                          check=True).stdout
    return dict(line.split("=", 1) for line in told.splitlines())


def usb_device():
    """The board's folder in sysfs."""
    return next(folder.parent for folder in pathlib.Path("/sys/bus/usb/devices").glob("*/idVendor")
                if folder.read_text(encoding="utf-8") == "1209\n")


class UdevTest(bench.BenchTest):
    def setUp(self):
        super().setUp()
        bench.wait_until(NAME.is_symlink, f"{NAME} to come")

    def test_a_port_has_the_name_of_its_boards_serial_number(self):
        self.assertEqual(NAME.resolve(), bench.PORT)
        self.assertEqual(group_and_mode(NAME), ("dialout", 0o660))

    def test_the_name_goes_with_the_board(self):
        bench.unplug()
        bench.wait_until(lambda: not NAME.is_symlink(), f"{NAME} to go")

    def test_the_name_stays_where_the_ports_number_does_not(self):
        held = os.open(NAME, os.O_RDWR | os.O_NOCTTY)
        self.addCleanup(lambda: os.close(held))
        bench.unplug()
        bench.wait_until(lambda: not NAME.is_symlink(), f"{NAME} to go")
        bench.plug()
        bench.wait_until(NAME.exists, f"{NAME} to come back")
        self.assertEqual(NAME.resolve(), pathlib.Path("/dev/ttyACM1"))

    def test_a_run_by_that_name_reads_the_board(self):
        self.start(bench.SimulatedBoard)
        run = self.start(bench.Run, source=f"serial:{NAME}")
        run.wait_for_rows(1)
        run.interrupt()
        self.assertEqual(run.end()[0], 0)

    def test_the_device_itself_is_for_its_group_and_for_who_sits_at_the_machine(self):
        device = properties(usb_device())
        self.assertEqual(group_and_mode(pathlib.Path(device["DEVNAME"])), ("plugdev", 0o660))
        self.assertIn(":uaccess:", device["TAGS"])
        self.assertIn(":uaccess:", properties(bench.PORT)["TAGS"])

    def test_modem_manager_is_told_to_leave_the_board_alone(self):
        self.assertEqual(properties(usb_device())["ID_MM_DEVICE_IGNORE"], "1")
        self.assertEqual(properties(bench.PORT)["ID_MM_PORT_IGNORE"], "1")

    def test_the_board_is_not_put_to_sleep(self):
        properties(usb_device())
        self.assertEqual((usb_device() / "power/control").read_text(encoding="utf-8"), "on\n")

    def test_lines_are_for_their_group(self):
        self.assertEqual(group_and_mode(pathlib.Path("/dev/gpiochip0")), ("gpio", 0o660))


if __name__ == "__main__":
    unittest.main()
