# SPDX-License-Identifier: Apache-2.0
# `penduline run`: the live pipeline at the real rate, Ctrl-C, and recordings that replay exactly.
import signal
import subprocess
import time
import unittest

from program import PROGRAM, RIGS, ProgramTest, run


class RunTest(ProgramTest):
    def test_a_recording_of_a_run_replays_byte_for_byte(self):
        rig = RIGS / "tcrt5000.toml"
        recording = self.folder / "rec.csv"
        live = run("run", "sim:", "--rig", rig, "--seconds", 10, "--fast", "--record", recording)
        self.assertEqual(run("replay", recording, "--rig", rig).stdout, live.stdout)
        self.assertEqual(run("run", f"file:{recording}", "--fast", "--rig", rig).stdout, live.stdout)

    def test_keeps_to_the_real_rate(self):
        start = time.monotonic()
        run("run", "sim:", "--rig", RIGS / "paper.toml", "--seconds", 1)
        # 20 samples are 19 periods of 50 ms; a busy machine may only be late.
        self.assertGreater(time.monotonic() - start, 0.95)

    def stopped_by(self, stop):
        """Starts an endless run, stops it at its tenth row and returns it ended."""
        process = subprocess.Popen([PROGRAM, "run", "sim:", "--rig", RIGS / "paper.toml", "--rate",
                                    "100"], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                   text=True)
        first = [process.stdout.readline() for _ in range(10)]
        process.send_signal(stop)
        out, err = process.communicate(timeout=30)
        return process.returncode, "".join(first) + out, err

    def test_rows_come_live_and_ctrl_c_ends_with_a_summary(self):
        for stop in (signal.SIGINT, signal.SIGTERM):
            status, out, err = self.stopped_by(stop)
            self.assertEqual(status, 0)
            self.assertTrue(out.endswith("\n"))
            self.assertIn(f"info: {len(out.splitlines()) - 1} samples at 100.000 Hz, 0 lost", err)

    def test_ctrl_c_ends_a_wait_for_the_standard_input(self):
        process = subprocess.Popen([PROGRAM, "replay", "-", "--rig", RIGS / "paper.toml"],
                                   stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, text=True)
        process.stdin.write("# penduline_recording = 1\n# rate_hz = 20\n# full_scale_counts = 65535\n"
                            "# reference_v = 3.3\nseq,t_us,x_on,x_off,y_on,y_off,flags\n"
                            "0,0,33000,0,33000,0,0\n")
        process.stdin.flush()
        time.sleep(0.5)
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(timeout=30), 0)
        self.assertIn("info: 1 samples", process.stderr.read())
        process.stdin.close()
        process.stdout.close()
        process.stderr.close()

    def test_options_of_a_simulation_are_refused_for_a_recording(self):
        recording, _ = self.simulate()
        done = run("run", f"file:{recording}", "--noise", 0.1, "--rig", RIGS / "paper.toml", status=2)
        self.assertIn("--noise: is for the source sim: only", done.stderr)

    def test_a_failure_comes_after_what_led_to_it(self):
        done = run("run", "sim:", "--case", 2, "--integrator", "euler", "--fast", "--rig",
                   RIGS / "paper.toml", status=1)
        said = [line.split(":")[0] for line in done.stderr.splitlines()]
        self.assertEqual(said[-1], "error")
        self.assertIn("the integrator has blown up", done.stderr)
        self.assertIn("info: 10 samples", done.stderr)

    def rig_with_lines(self, keys):
        return self.write("rig.toml", (RIGS / "paper.toml").read_text() + "[gpio]\n" + keys)

    def test_options_of_lines_are_for_a_board_that_is_there(self):
        rig = self.rig_with_lines('reset = "A"\nrelease = "B"\n')
        recording, _ = self.simulate()
        for option in (["--reset"], ["--release", "1"]):
            for source in ("sim:", f"file:{recording}"):
                done = run("run", source, "--rig", rig, *option, status=2)
                self.assertIn(f"{option[0]}: is for a board only", done.stderr)
            done = run("run", f"serial:{recording}", "--rig", rig, *option, status=2)
            self.assertIn(f"{option[0]}: is for a board, not for its bytes in a file", done.stderr)

    def test_options_of_lines_need_the_lines_in_the_rig(self):
        rig = RIGS / "paper.toml"
        for option, key in ((["--reset"], "reset"), (["--release", "1"], "release")):
            done = run("run", "serial:/dev/null", "--rig", rig, *option, status=2)
            self.assertIn(f"{option[0]}: found no [gpio] {key} in {rig}, expected the line's name",
                          done.stderr)

    def test_the_time_of_the_release_is_checked(self):
        done = run("run", "auto", "--rig", RIGS / "paper.toml", "--release", "-1", status=2)
        self.assertIn("--release: found -1, expected a number from 0 to 86400", done.stderr)

    def test_a_line_that_this_computer_does_not_have_ends_a_run(self):
        rig = self.rig_with_lines('status_led = "no such line"\n')
        done = run("run", "serial:/dev/null", "--rig", rig, status=1)
        self.assertRegex(done.stderr, "^error: GPIO line 'no such line': [^\n]*\n$")

    def test_a_rig_with_lines_serves_a_simulation_that_uses_none(self):
        rig = self.rig_with_lines('status_led = "no such line"\ntrigger = "nor this"\n')
        done = run("run", "sim:", "--rig", rig, "--seconds", 1, "--fast")
        self.assertNotIn("warning", done.stderr)

    def test_an_unknown_source_says_which_there_are(self):
        done = run("run", "magic:", "--rig", RIGS / "paper.toml", status=2)
        self.assertIn("SOURCE: found 'magic:', expected auto, serial:PATH, usb:VID:PID, file:PATH or "
                      "sim:\n", done.stderr)

    def test_a_recording_without_samples_is_a_recording(self):
        recording = self.folder / "rec.csv"
        rig = RIGS / "paper.toml"
        run("run", "sim:", "--rig", rig, "--seconds", 0, "--fast", "--record", recording)
        done = run("replay", recording, "--rig", rig, "--strict", status=3)
        self.assertIn("found no sample, expected at least one", done.stderr)


if __name__ == "__main__":
    unittest.main()
