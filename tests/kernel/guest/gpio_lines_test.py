# SPDX-License-Identifier: Apache-2.0
# `penduline run` and who else there is on GPIO lines: the board's reset, others who hold them, its own end.
import pathlib
import signal
import subprocess
import time
import unittest

import bench
import lines

CONFIG = pathlib.Path("/sys/kernel/config/gpio-sim")


class ResetTest(lines.LinesTest):
    def test_the_board_is_reset_before_it_is_asked(self):
        self.start(bench.SimulatedBoard)
        watch = self.start(lines.Watch, self.reset)
        run = self.run_with_lines("--reset", "--once")
        run.wait_for_rows(1)
        self.interrupt(run)
        self.assertEqual(watch.levels(), [1, 0])
        (begun, _), (ended, _) = watch.changes
        self.assertAlmostEqual(ended - begun, 0.1, delta=0.01)

    def test_a_reset_that_is_active_low_pulls_its_wire_down_and_never_drives_it_high(self):
        lines.write_rig('[gpio]\nreset = { line = "penduline-reset", active_low = true }\n')
        self.reset.pull("up")
        self.start(bench.SimulatedBoard)
        watch = self.start(lines.Watch, self.reset)
        run = self.run_with_lines("--reset")
        run.wait_for_rows(1)
        self.assertEqual(lines.flags_of("penduline-reset"),
                         {"kernel", "is_out", "active_low", "open_drain"})
        self.interrupt(run)
        # gpio-sim shows what the pull does to a wire that is let go only when the line is given back.
        self.assertEqual(watch.levels(), [0, 1])

    def test_a_board_that_comes_back_after_the_reset_is_not_too_late_for_once(self):
        bench.unplug()
        bench.wait_until(lambda: not bench.PORT.exists(), "the port to go")
        run = self.run_with_lines("--reset", "--once")
        time.sleep(1)
        self.plug()
        self.start(bench.SimulatedBoard)
        run.wait_for_rows(1)

    def test_a_board_that_does_not_talk_is_reset_and_again_with_more_patience(self):
        board = self.start(bench.PlayedBoard)
        watch = self.start(lines.Watch, self.reset, period_s=0.02)
        began = time.monotonic()
        run = self.run_with_lines()
        bench.wait_until(lambda: len(watch.changes) == 4, "two pulses", seconds=60)
        self.assertEqual(watch.levels(), [1, 0, 1, 0])
        first, second = watch.changes[0][0], watch.changes[2][0]
        # An attempt to talk takes 3 s and more, and is not broken off.
        self.assertTrue(10 <= first - began < 18, first - began)
        self.assertTrue(20 <= second - first < 25, second - first)
        board.wait_for_question()
        board.send(bench.hello() + bench.samples(0, 1))
        run.wait_for_rows(1)
        said = self.interrupt(run)
        self.assertEqual(said.count(
            "warning: reset the board, which has not talked for 10 s; while it stays so again after "
            "20 s, 40 s and so on"), 1)

    def test_a_board_that_is_not_there_is_not_reset(self):
        bench.unplug()
        watch = self.start(lines.Watch, self.reset, period_s=0.02)
        run = self.run_with_lines()
        time.sleep(25)
        self.assertEqual(watch.changes, [])
        self.interrupt(run)


class HoldingTest(lines.LinesTest):
    def setUp(self):
        super().setUp()
        self.start(bench.SimulatedBoard)

    def hold_all(self):
        """A run that holds every line, the magnet and the light active."""
        run = self.run_with_lines("--release", "1000", "--record", lines.RECORDING)
        run.wait_for_rows(1)
        bench.wait_until(self.led.level, "the light")
        self.assertEqual(self.magnet.level(), 1)
        for name in lines.NAMES:
            self.assertIn("kernel", lines.flags_of(name), name)
        return run

    def assert_let_go(self):
        """All wires are as their pulls have them, and every line is free again."""
        self.assertEqual([self.reset.level(), self.magnet.level(), self.led.level()], [0, 0, 0])
        for name in lines.NAMES:
            self.assertNotIn("kernel", lines.flags_of(name), name)


class RefusalTest(HoldingTest):
    def refusal(self, *options, **process):
        """The one line of a run that cannot have a line."""
        done = subprocess.run(
            [bench.PROGRAM, "run", f"serial:{bench.PORT}", "--rig", lines.RIG, *options],
            capture_output=True, text=True, check=False, timeout=30, **process)
        self.assertEqual((done.returncode, done.stdout), (1, ""), done.stderr)
        return done.stderr

    def test_a_line_that_is_not_there_is_told(self):
        lines.write_rig('[gpio]\nstatus_led = "GPIO99"\n')
        self.assertRegex(self.refusal(), r"^error: GPIO line 'GPIO99': not found on gpiochip\d; "
                                         "gpioinfo lists the lines' names\n$")

    def test_a_line_that_is_held_is_told_with_its_holder(self):
        self.hold_all()
        lines.write_rig('[gpio]\nrelease = "penduline-magnet"\n')
        self.assertEqual(
            self.refusal("--release", "1"),
            "error: GPIO line 'penduline-magnet': held by 'penduline', expected a free line\n")
        lines.write_rig('[gpio]\ntrigger = "penduline-trigger"\n')
        self.assertEqual(
            self.refusal("--record", lines.RECORDING),
            "error: GPIO line 'penduline-trigger': held by 'penduline', expected a free line\n")

    def test_a_name_of_two_lines_is_told_with_their_places(self):
        other = CONFIG / "other"
        (other / "bank/line5").mkdir(parents=True)
        (other / "bank/num_lines").write_text("6", encoding="utf-8")
        (other / "bank/line5/name").write_text("penduline-status-led", encoding="utf-8")
        (other / "live").write_text("1", encoding="utf-8")
        try:
            self.assertRegex(self.refusal(),
                             r"^error: GPIO line 'penduline-status-led': found line 2 of gpiochip\d "
                             r"and line 5 of gpiochip\d, expected one line of this name\n$")
        finally:
            (other / "live").write_text("0", encoding="utf-8")
            for folder in (other / "bank/line5", other / "bank", other):
                folder.rmdir()

    def test_a_chip_that_may_not_be_opened_is_told(self):
        lines.write_rig('[gpio]\nstatus_led = "penduline-status-led"\n')
        self.assertRegex(self.refusal(user=65534, group=65534),
                         r"^error: GPIO line 'penduline-status-led': /dev/gpiochip\d: Permission "
                         r"denied, expected to find the line there \(as a rule the group gpio may "
                         r"open chips\)\n$")


class EndTest(HoldingTest):
    def test_an_interrupted_run_lets_go(self):
        self.interrupt(self.hold_all())
        self.assert_let_go()

    def test_a_terminated_run_lets_go(self):
        run = self.hold_all()
        run.process.terminate()
        self.assertEqual(run.end()[0], 0)
        self.assert_let_go()

    def test_a_run_that_fails_lets_go(self):
        run = self.run_with_lines("--release", "1000", "--once")
        run.wait_for_rows(1)
        self.assertEqual(self.magnet.level(), 1)
        bench.unplug()
        self.assertEqual(run.end()[0], 1)
        self.assert_let_go()

    def test_the_kernel_lets_go_for_a_run_that_is_killed(self):
        for how in (signal.SIGKILL, signal.SIGSEGV):
            with self.subTest(how=how.name):
                run = self.hold_all()
                run.process.send_signal(how)
                run.process.wait(timeout=10)
                self.assert_let_go()


if __name__ == "__main__":
    unittest.main()
