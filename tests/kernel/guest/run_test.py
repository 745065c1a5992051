# SPDX-License-Identifier: Apache-2.0
# `penduline run` reads a board through the kernel's cdc_acm.
import math
import subprocess
import unittest

import bench


class RunTest(bench.BenchTest):
    def assert_unbroken(self, rows):
        """Each sample follows on the one before."""
        numbers = [int(row["seq"]) for row in rows]
        self.assertEqual(numbers, list(range(numbers[0], numbers[0] + len(rows))))

    def test_a_boards_samples_become_angles(self):
        self.start(bench.SimulatedBoard, "--case", "conical", "--theta-deg", "10", "--noise", "0")
        run = self.start(bench.Run)
        run.wait_for_rows(40)
        run.interrupt()
        status, said = run.end()
        self.assertEqual(status, 0)
        self.assertRegex(said[-1], r"^info: 4\d samples at 20.000 Hz, 0 lost, 2\d with angles; ")
        self.assert_unbroken(run.rows())
        angles = [row for row in run.rows() if row["theta1_rad"]]
        self.assertGreaterEqual(len(angles), 25)
        for row in angles:
            theta1, theta2 = float(row["theta1_rad"]), float(row["theta2_rad"])
            tilt = math.degrees(math.acos(math.cos(theta1) * math.cos(theta2)))
            self.assertAlmostEqual(tilt, 10, delta=0.1)

    def test_a_port_is_found_by_its_serial_number(self):
        bench.wait_until(bench.PORT_BY_ID.exists, "udev's name")
        self.start(bench.SimulatedBoard)
        run = self.start(bench.Run, source=f"serial:{bench.PORT_BY_ID}")
        run.wait_for_rows(1)
        run.interrupt()
        self.assertEqual(run.end()[0], 0)

    def test_whole_packets_which_the_board_ends_with_an_empty_one_do_not_end_the_run(self):
        board = self.start(bench.PlayedBoard)
        run = self.start(bench.Run)
        greeting = bench.hello()
        board.wait_for_question()
        board.send(greeting + bytes(bench.PACKET_BYTES - len(greeting)))
        for block in range(3):
            frames = bench.samples(16 * block, 16)
            self.assertEqual(len(frames), bench.PACKET_BYTES)
            board.send(frames)
            run.wait_for_rows(16 * (block + 1))
        run.interrupt()
        self.assertEqual(run.end()[0], 0)
        self.assert_unbroken(run.rows())
        self.assertEqual(len(run.rows()), 48)

    def test_a_board_that_says_nothing_is_told_by_its_port(self):
        self.start(bench.PlayedBoard)
        status, said = self.start(bench.Run, "--once").end()
        self.assertEqual((status, said), (1, [
            "error: /dev/ttyACM0: found no bytes, expected a Penduline board that says Hello"]))

    def test_libusb_reads_the_same_board_and_gives_the_port_back(self):
        self.start(bench.SimulatedBoard)
        run = self.start(bench.Run, source="usb:1209:0001:0000000000000001")
        run.wait_for_rows(20)
        self.assertFalse(bench.PORT.exists(), "the kernel's driver has let go")
        run.interrupt()
        self.assertEqual(run.end()[0], 0)
        self.assert_unbroken(run.rows())
        bench.wait_until(bench.PORT.exists, "the port to come back")

    def test_auto_finds_the_board_by_its_usb_identity(self):
        self.start(bench.SimulatedBoard)
        run = self.start(bench.Run, source="auto")
        run.wait_for_rows(1)
        run.interrupt()
        self.assertEqual(run.end()[0], 0)

    def test_no_port_is_told_by_its_name(self):
        bench.unplug()
        bench.wait_until(lambda: not bench.PORT.exists(), "the port to go")
        status, said = self.start(bench.Run, "--once").end()
        self.assertEqual((status, said), (1, ["error: /dev/ttyACM0: No such file or directory"]))


class DevicesTest(bench.BenchTest):
    def devices(self, status=0):
        done = subprocess.run([bench.PROGRAM, "devices"], capture_output=True, text=True,
                              check=False, timeout=30)
        self.assertEqual(done.returncode, status, done.stderr)
        return [line.split(maxsplit=4) for line in done.stdout.splitlines()], done.stderr

    def test_a_board_is_listed_with_what_it_says_of_itself(self):
        self.start(bench.SimulatedBoard)
        rows, _ = self.devices()
        self.assertEqual(rows[0][:4], ["port", "serial", "number", "board"])
        port, serial_number, board, _, state = rows[1]
        self.assertEqual((port, serial_number, board), ("/dev/ttyACM0", "0000000000000001", "sim"))
        self.assertEqual(state, "samples at 20 Hz, emitters switched")

    def test_a_board_that_is_read_is_left_alone(self):
        self.start(bench.SimulatedBoard)
        run = self.start(bench.Run)
        run.wait_for_rows(1)
        self.assertIn("another program has the port", " ".join(self.devices()[0][1]))
        run.wait_for_rows(20)

    def test_no_board_is_an_error_that_says_what_was_looked_for(self):
        bench.unplug()
        bench.wait_until(lambda: not bench.PORT.exists(), "the port to go")
        self.assertIn("error: found no board: looked for", self.devices(status=1)[1])


if __name__ == "__main__":
    unittest.main()
