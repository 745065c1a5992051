#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
# The Nucleo's image as a user flashes it, in QEMU: boot, sampling, commands, faults, restart.
#
# Not tried here: the flash's writing, so neither that an uploaded rig survives a reset (QEMU's flash is
# a ROM; that writing fails cleanly is tried); the pins, clocks, baud rate and watchdog (QEMU has none);
# a host that is absent (a UART cannot know); the counter's wrap (its 64 bits are a sum, nothing wraps).
import csv
import math
import pathlib
import random
import struct
import tempfile
import time
import unittest
import zlib

from machine import Machine, counts, missing, only  # and it puts tests/program on the path
import program
import wire

EMITTER_LIT, EMITTER_DARK = 1, 2
CAUSE_SOFTWARE = 3
FLAG_SATURATED = 1
FLAG_RESTARTED = 4
FLAG_LATE = 8


def setUpModule():
    if (reason := missing()) is not None:
        raise unittest.SkipTest(reason)


def flags(sample):
    """Of a sample, but for FLAG_LATE: a machine that sleeps in a window wakes by the host's clock."""
    return sample.flags & ~FLAG_LATE


class BoardTest(unittest.TestCase):
    def board(self, **options):
        board = Machine(**options)
        self.addCleanup(board.close)
        return board

    def sampling_board(self, **options):
        """One that has started: QEMU throws away what comes before its receiver is on."""
        board = self.board(**options)
        board.wait_for("Sample")
        return board

    def assert_unbroken(self, samples):
        """No number is missing and time goes on."""
        self.assertGreater(len(samples), 1)
        for before, sample in zip(samples, samples[1:]):
            self.assertEqual(sample.seq, before.seq + 1)
            self.assertGreater(sample.t_us, before.t_us)

    def assert_sound(self, board):
        """Every frame arrived whole, and the program did nothing that QEMU has to complain of."""
        self.assertEqual(board.splitter.damaged, [])
        self.assertEqual(board.log.read_text(encoding="utf-8"), "")


class Boot(BoardTest):
    def test_says_who_it_is_before_the_first_sample(self):
        board = self.board()
        messages = board.run(10, lambda message: type(message).__name__ == "Sample")
        self.assertEqual([type(message).__name__ for message in messages[:3]],
                         ["Hello", "Status", "Sample"])
        hello, status, sample = messages[:3]
        self.assertEqual(hello.protocol, 1)
        self.assertEqual(hello.board.rstrip(b"\0"), b"nucleo")
        self.assertEqual(hello.tick_hz, 1_000_000)
        self.assertEqual(hello.rate_millihz, 20_000)
        self.assertEqual(hello.full_scale_counts, 65535)
        self.assertEqual(hello.reference_uv, 3_300_000)
        self.assertEqual(hello.sensor_count, 2)
        self.assertEqual(hello.conversions, 32)
        self.assertEqual(status.resets, 0)
        self.assertGreater(status.stack_free_bytes, 2048)
        self.assertEqual((sample.seq, flags(sample)), (0, FLAG_RESTARTED))
        self.assert_sound(board)


class Sampling(BoardTest):
    def test_a_minute_of_swing_comes_as_injected_and_no_sample_is_lost(self):
        """Each sample's codes are injected after the one before has come, so they stand still while
        it is taken. Where the host was too late for that, as uneven arrivals show, the sample's
        values are not judged; its number is."""
        board = self.board()
        samples, arrivals_s, expected = [], [], [(0, 0)]
        while len(samples) < 1200:
            for sample in only("Sample", board.receive(1)):
                samples.append(sample)
                arrivals_s.append(time.monotonic())
                swing = math.pi * sample.t_us / 1e6
                expected.append((round(2048 + 1500 * math.sin(swing)),
                                 round(1800 + 1200 * math.cos(1.3 * swing))))
                board.inject(*expected[-1])
        self.assert_unbroken(samples)
        judged = 0
        for i in range(2, len(samples)):
            intervals_s = [arrivals_s[j] - arrivals_s[j - 1] for j in (i - 1, i)]
            if all(0.035 < interval_s < 0.065 for interval_s in intervals_s):
                judged += 1
                x, y = map(counts, expected[i])
                self.assertEqual(samples[i][2:6], (x, x, y, y), f"sample {i}")
        self.assertGreater(judged, 600)
        self.assertEqual(board.status().overruns, 0)
        self.assert_sound(board)

    def test_the_clock_goes_as_fast_as_the_world_s(self):
        """It may seem slower where the host is too busy to run the board in real time."""
        board = self.board()
        first, from_s = board.wait_for("Sample"), time.monotonic()
        last = only("Sample", board.run(3))[-1]
        host_s, board_s = time.monotonic() - from_s, (last.t_us - first.t_us) / 1e6
        self.assertLess(board_s, 1.03 * host_s)
        self.assertGreater(board_s, 0.5 * host_s)

    def test_a_code_at_the_top_is_flagged_as_saturated(self):
        board = self.sampling_board()
        board.inject(4095, 100)
        sample = only("Sample", board.run(0.5))[-1]
        self.assertEqual((sample.x_on, flags(sample)), (65535, FLAG_SATURATED))

    def test_the_rate_changes_when_told_and_numbers_go_on(self):
        board = self.sampling_board()
        result, before = board.command("SetRate", 50_000)
        self.assertEqual(result, "done")
        after = board.run(2.5)
        samples = only("Sample", before + after)
        self.assert_unbroken(samples)
        period_us = (samples[-1].t_us - samples[-101].t_us) / 100
        self.assertAlmostEqual(period_us, 20_000, delta=200)
        self.assertEqual(board.status().rate_millihz, 50_000)
        for refused in (999, 1_000_001):
            self.assertEqual(board.command("SetRate", refused)[0], "out_of_range")

    def test_lit_all_light_is_the_reading_and_dark_all_is_ambient(self):
        board = self.sampling_board()
        board.inject(3000, 1000)
        x, y = counts(3000), counts(1000)
        for mode, readings in ((EMITTER_LIT, (x, 0, y, 0)), (EMITTER_DARK, (x, x, y, y))):
            self.assertEqual(board.command("SetEmitter", mode)[0], "done")
            self.assertEqual(only("Sample", board.run(0.3))[-1][2:6], readings)
            self.assertEqual(board.status().emitter_mode, mode)
        self.assertEqual(board.command("SetEmitter", 3)[0], "out_of_range")


class Link(BoardTest):
    def test_garbage_and_cut_commands_cost_only_themselves(self):
        board = self.sampling_board()
        noise = bytes(random.Random(1).randrange(1, 256) for _ in range(100))
        whole = wire.encode("AskHello", 9)
        for damage in (noise + b"\0", whole[:-3] + b"\0", whole[:4] + b"\xff" + whole[5:]):
            bad_before = board.status().bad_frames
            board.send(damage)
            result, messages = board.command("AskHello")
            self.assertEqual((result, len(only("Hello", messages))), ("done", 1))
            self.assertEqual(board.status().bad_frames, bad_before + 1)
        self.assert_unbroken(only("Sample", board.run(0.5)))
        self.assert_sound(board)

    def test_newer_and_short_commands_are_refused_by_name(self):
        board = self.sampling_board()
        for body, result in ((b"\x7e\x05", "unknown_command"), (b"\x44\x05\x01", "wrong_length")):
            board.send(wire.encode_body(body))
            reply = board.wait_for("Reply")
            self.assertEqual((reply.command, reply.token), (body[0], 5))
            self.assertEqual(wire.RESULTS[reply.result], result)

    def test_a_flood_of_commands_loses_no_sample(self):
        """As fast as 460800 baud carry it, for two seconds."""
        board = self.sampling_board()
        messages, token, from_s = [], 0, time.monotonic()
        while (passed_s := time.monotonic() - from_s) < 2:
            while token * 11 < passed_s * 46_080:
                token += 1
                board.send(wire.encode("Ping", token))
            messages += board.receive(0.002)
        messages += board.run(0.5)
        tokens = [pong.token for pong in only("Pong", messages)]
        self.assertEqual(tokens, sorted(set(tokens)))
        self.assertGreater(len(tokens), 1000)
        self.assert_unbroken(only("Sample", messages))
        status = board.status()
        self.assertEqual((status.overruns, status.dropped_frames), (0, 0))
        self.assert_sound(board)


class Restart(BoardTest):
    def test_the_command_reboot_begins_anew_and_says_why(self):
        board = self.board()
        first = board.wait_for("Hello")
        self.assertEqual(board.command("Reboot", 0)[0], "done")
        messages = board.run(10, lambda message: type(message).__name__ == "Hello")
        messages += board.run(0.5)
        second, = only("Hello", messages)
        self.assertNotEqual(second.boot_id, first.boot_id)
        after = messages[messages.index(second):]
        status, sample = only("Status", after)[0], only("Sample", after)[0]
        self.assertEqual((status.reset_cause, status.resets), (CAUSE_SOFTWARE, 1))
        self.assertEqual((sample.seq, flags(sample)), (0, FLAG_RESTARTED))
        self.assertEqual((status.fault_pc, status.fault_line), (0, 0))


class Rig(BoardTest):
    OFFSET_M, ARM_M, GAP_AT_ZERO_M, SLOPE_M_PER_V = 0.02, 0.02, 0.031, -0.006

    def image(self, estimator=wire.GAUSS_NEWTON):
        return wire.rig_image(self.GAP_AT_ZERO_M, self.SLOPE_M_PER_V, self.OFFSET_M, self.ARM_M, estimator)

    def test_a_flash_that_takes_nothing_is_told_and_sampling_goes_on(self):
        board = self.sampling_board()
        image = self.image()
        self.assertEqual(board.command("EndRig")[0], "no_upload")
        self.assertEqual(board.command("BeginRig", len(image), zlib.crc32(image))[0], "done")
        for at in range(0, len(image), 48):
            part = image[at:at + 48]
            self.assertEqual(board.command("RigPart", at, len(part), part)[0], "done")
        result, messages = board.command("EndRig")
        self.assertEqual(result, "store_failed")
        self.assertEqual(board.command("EraseRig")[0], "store_failed")
        # QEMU's empty flash is full of zeros, which are neither a rig nor erased.
        self.assertEqual(board.status().store, wire.STORE_DAMAGED)
        for _ in range(6):
            board.wait_for("Sample")
            messages += board.run(0.05)
        self.assertEqual(only("Angles", messages), [])
        self.assert_sound(board)

    def test_with_a_rig_in_the_store_it_computes_the_angles_itself(self):
        """The rig is laid into the flash from outside. The gaps of a tilted disc come from the
        forward equations (docs/method.md eq. 7), through the sensors' response to codes."""
        board = self.sampling_board(store=wire.stored(self.image()))
        theta1_rad, theta2_rad = 0.10, -0.07
        a, b = -math.tan(theta2_rad) / math.cos(theta1_rad), math.tan(theta1_rad)
        c = -self.OFFSET_M * math.sqrt(1 + a * a + b * b)
        gaps_m = [-(slope * self.ARM_M + c) for slope in (a, b)]
        codes = [round((gap_m - self.GAP_AT_ZERO_M) / self.SLOPE_M_PER_V / 3.3 * 4095)
                 for gap_m in gaps_m]
        board.inject(*codes)
        # There is no light to switch here: dark readings would be as large as lit ones.
        self.assertEqual(board.command("SetEmitter", EMITTER_LIT)[0], "done")
        self.assertEqual(board.command("SetRate", 50_000)[0], "done")
        messages, solved = [], []
        for _ in range(30):  # a window that the machine misses has the board's filter start over
            messages += board.run(1)
            solved = [angle for angle in only("Angles", messages) if not math.isnan(angle.theta1_rad)]
            if len(solved) > 20:
                break
        angles = only("Angles", messages)
        begun = angles[1].seq  # the first sample may have come with the command's reply
        sampled = [sample.seq for sample in only("Sample", messages) if sample.seq >= begun]
        self.assertEqual([angle.seq for angle in angles[1:]], sampled[:len(angles) - 1])
        # Half a code is 2.4 um of gap, 0.12 mrad.
        self.assertAlmostEqual(solved[-1].theta1_rad, theta1_rad, delta=2e-4)
        self.assertAlmostEqual(solved[-1].theta2_rad, theta2_rad, delta=2e-4)
        self.assertEqual(board.status().store, wire.STORE_VALID)
        self.assert_sound(board)

    def test_its_angles_are_the_host_s_to_a_hundred_thousandth(self):
        for estimator, number in (("gn", wire.GAUSS_NEWTON), ("ekf", wire.KALMAN)):
            with self.subTest(estimator):
                self.check_angles(estimator, self.image(number))

    def check_angles(self, estimator, image):
        board = self.sampling_board(store=wire.stored(image))
        self.assertEqual(board.command("SetEmitter", EMITTER_LIT)[0], "done")
        # The estimator starts over, so that both begin with the same sample.
        messages = board.command("SetRate", 20_000)[1]
        messages = messages[messages.index(only("Reply", messages)[-1]) + 1:]
        while len(only("Sample", messages)) < 160:
            messages += board.receive(1)
            swing = len(messages) / 7
            board.inject(round(600 + 300 * math.sin(swing)), round(700 + 250 * math.cos(1.3 * swing)))
        samples = only("Sample", messages)
        self.assert_unbroken(samples)
        host = {int(row["seq"]): row for row in self.replayed(samples, estimator)}
        compared = 0
        for angles in only("Angles", messages):
            row = host.get(angles.seq)
            if row is None or row["theta1_rad"] == "":
                continue  # the host's filter is still filling
            compared += 1
            self.assertAlmostEqual(angles.theta1_rad, float(row["theta1_rad"]), delta=1e-5)
            self.assertAlmostEqual(angles.theta2_rad, float(row["theta2_rad"]), delta=1e-5)
        self.assertGreater(compared, 80)

    def replayed(self, samples, estimator):
        """The rows that the program makes of the samples, with the same rig."""
        folder = tempfile.TemporaryDirectory(prefix="penduline-")
        self.addCleanup(folder.cleanup)
        rig, recording = pathlib.Path(folder.name) / "rig.toml", pathlib.Path(folder.name) / "rec.csv"
        sensors = "".join(
            f"""[[sensor]]
            position_m = {position}
            response = {{ model = "linear", gap_at_zero_m = {self.GAP_AT_ZERO_M}, slope_m_per_v = {self.SLOPE_M_PER_V} }}
            """ for position in ([self.ARM_M, 0.0, 0.0], [0.0, self.ARM_M, 0.0]))
        rig.write_text(f"""[pendulum]
            length_m = 0.3
            mass_kg = 0.1
            gravity_m_s2 = 9.8
            damping_per_s = 0.01
            [disc]
            offset_m = {self.OFFSET_M}
            diameter_m = 0.12
            {sensors}""", encoding="utf-8")
        recording.write_text(
            "# penduline_recording = 1\n# rate_hz = 20.0\n# full_scale_counts = 65535\n"
            "# reference_v = 3.3\nseq,t_us,x_on,x_off,y_on,y_off,flags\n"
            + "".join(",".join(map(str, sample)) + "\n" for sample in samples), encoding="utf-8")
        rows = program.run("replay", recording, "--rig", rig, "--estimator", estimator).stdout
        return list(csv.DictReader(rows.splitlines()))

    def test_a_damaged_rig_in_the_store_is_told_and_not_used(self):
        damaged = bytearray(wire.stored(self.image()))
        damaged[20] ^= 1
        board = self.board(store=bytes(damaged))
        messages = board.run(0.5)
        self.assertEqual(only("Status", messages)[0].store, wire.STORE_DAMAGED)
        self.assertEqual(only("Angles", messages), [])


if __name__ == "__main__":
    unittest.main(verbosity=2)
