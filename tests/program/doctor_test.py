# SPDX-License-Identifier: Apache-2.0
# `penduline doctor`: what it says of a good set-up, and of the faults that people have.
import os
import pty
import re
import shlex
import shutil
import signal
import subprocess
import time
import tty
import unittest

from program import PROGRAM, RIGS, ProgramTest, run
from sim_board import WITHOUT_PTS, SimBoard

RIG = RIGS / "tcrt5000.toml"
STILL = ["--held", "--theta-deg", "0"]
SATURATED = 1


def verdicts(done):
    """What it says of each subject: its health, what it found, its advice."""
    found = {}
    for health, subject, text, advice in re.findall(
            r"^(good|doubtful|bad) +([^:]+): (.*)\n(?: +-> (.*)\n)?", done.stdout, re.MULTILINE):
        found[subject] = (health, text, advice)
    return found


def commands(advice):
    """The commands of the program that an advice names."""
    return re.findall(r"'(penduline [^']*)'", advice)


class DoctorTest(ProgramTest):
    @unittest.skipIf(WITHOUT_PTS, "no pseudo-terminals: /dev/pts is not mounted")
    def test_a_good_board_with_a_still_pendulum_is_good_throughout(self):
        board = SimBoard(self.folder / "port", *STILL)
        self.addCleanup(board.close)
        done = run("doctor", f"serial:{board.port}", "--rig", RIGS / "paper.toml", "--seconds", "3", "--strict")
        found = verdicts(done)
        self.assertEqual({health for health, _, _ in found.values()}, {"good"}, done.stdout)
        self.assertEqual(list(found)[:5], ["board", "firmware", "health", "rate", "saturation"])
        self.assertNotIn("busy", found["health"][1])
        self.assertEqual(found["rate"][1], "61 samples at 20 Hz, none lost, none late")
        self.assertIn("zero within 0.0", found["sensor Sx gap"][1])
        self.assertEqual(done.stdout.splitlines()[-1], f"all {len(found)} checks are good")

    @unittest.skipIf(os.path.exists("/dev/ttyACM0"), "a board may be plugged in")
    def test_without_a_board_it_says_what_it_looked_for_and_what_to_do(self):
        health, text, advice = verdicts(run("doctor", status=1))["board"]
        self.assertEqual(health, "bad")
        self.assertIn("looked for a serial port of the USB device 1209:0001", text)
        self.assertIn("a cable that carries data", advice)

    def test_a_port_that_is_not_there(self):
        health, text, _ = verdicts(run("doctor", "serial:/dev/nowhere", status=1))["board"]
        self.assertEqual((health, text), ("bad", "/dev/nowhere: no such port"))

    @unittest.skipIf(WITHOUT_PTS, "no pseudo-terminals: /dev/pts is not mounted")
    def test_a_port_without_permission(self):
        board = SimBoard(self.folder / "port", *STILL)
        self.addCleanup(board.close)
        os.chmod(board.port, 0)
        program, nobody = PROGRAM, {}
        if os.geteuid() == 0:  # who may open every port
            self.folder.chmod(0o755)
            program = shutil.copy(PROGRAM, self.folder / "penduline")
            nobody = {"user": 65534, "group": 65534, "extra_groups": [], "cwd": "/"}
        done = subprocess.run([program, "doctor", f"serial:{board.port}"], capture_output=True,
                              text=True, check=False, timeout=60, **nobody)
        self.assertEqual(done.returncode, 1, done.stderr)
        health, text, advice = verdicts(done)["permission"]
        self.assertEqual((health, text),
                         ("bad", f"{board.port}: you may not read and write it"))
        self.assertIn("dialout", advice)

    def interrupted(self, source, *options, after_s):
        """What it says that gets a Ctrl-C."""
        process = subprocess.Popen([PROGRAM, "doctor", f"serial:{source}", *options],
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        time.sleep(after_s)
        process.send_signal(signal.SIGINT)
        stdout, stderr = process.communicate(timeout=30)
        return subprocess.CompletedProcess(process.args, process.returncode, stdout, stderr)

    @unittest.skipIf(WITHOUT_PTS, "no pseudo-terminals: /dev/pts is not mounted")
    def test_ctrl_c_while_a_board_is_asked_is_no_fault_of_the_board(self):
        silent, port = pty.openpty()
        self.addCleanup(os.close, silent)
        self.addCleanup(os.close, port)
        tty.setraw(port)
        done = self.interrupted(os.ttyname(port), "--strict", after_s=1)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(list(verdicts(done)), ["board"])
        self.assertTrue(done.stdout.endswith(
            "\ninterrupted: what is left was not looked at; of 1 checks 0 want something done\n"))

    @unittest.skipIf(WITHOUT_PTS, "no pseudo-terminals: /dev/pts is not mounted")
    def test_ctrl_c_while_it_listens_ends_with_what_was_heard(self):
        board = SimBoard(self.folder / "port", *STILL)
        self.addCleanup(board.close)
        done = self.interrupted(board.port, "--seconds", "60", after_s=4)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn("sensor 2 noise", verdicts(done))
        self.assertIn("\ninterrupted: ", done.stdout)

    def assert_can_be_typed(self, advice, count):
        """Its commands are right ones: without a board and files they fail, but not of their options."""
        rig = shutil.copy(RIG, self.folder / "rig.toml")
        found = commands(advice)
        self.assertEqual(len(found), count, advice)
        for command in found:
            arguments = shlex.split(command)[1:]
            if arguments[0] == "run":
                arguments += ["--once"]
            self.assertTrue(rig.exists())
            run(*(each.replace("auto", "serial:/dev/nowhere") for each in arguments), status=1,
                cwd=self.folder)

    def test_commands_in_advice_can_be_typed_as_they_stand(self):
        recording, _ = self.simulate("--seconds", "10", *STILL, rig=RIG.name)
        lines = recording.read_text().splitlines(True)
        rows = [re.sub(r"^(\d+,\d+,\d+),\d+,(\d+),\d+,\d+", r"\1,0,\2,0,8", line)
                for line in lines]  # no ambient light, and all late
        dark = self.write("dark.csv", "".join(rows))
        found = verdicts(run("doctor", f"file:{dark}"))
        self.assertIn("--rate 10'", found["rate"][2])
        self.assert_can_be_typed(found["rate"][2], 1)
        self.assertIn("--emitter switched'", found["sensor 1 ambient light"][2])
        self.assert_can_be_typed(found["sensor 1 ambient light"][2], 1)
        few = self.write("few.csv", "".join(lines[:20]))
        self.assert_can_be_typed(verdicts(run("doctor", f"file:{few}"))["pendulum"][2], 2)
        found = self.examine("--held", "--theta-deg", "1", "--gap-noise", "3e-5")
        self.assert_can_be_typed(found["sensor Sx gap"][2], 2)
        self.assert_can_be_typed(found["sensor Sx noise"][2], 2)

    def test_a_recording_that_is_there_is_not_what_advice_calibrates_by(self):
        recording, _ = self.simulate("--seconds", "10", "--held", "--theta-deg", "1", rig=RIG.name)
        recording.rename(self.folder / "still.csv")
        done = run("doctor", "file:still.csv", "--rig", RIG, cwd=self.folder)
        record, calibrate = commands(verdicts(done)["sensor Sx gap"][2])
        self.assertIn("--record still-2.csv", record)
        self.assertIn("calibrate rest still-2.csv", calibrate)

    def examine(self, *simulation, rig=RIG, status=0):
        """A simulated recording looked over."""
        recording, _ = self.simulate("--seconds", "10", *simulation, rig=rig.name)
        return verdicts(run("doctor", f"file:{recording}", "--rig", rig, status=status))

    def test_a_recording_with_much_light_is_told_to_be_shaded(self):
        health, text, advice = self.examine(*STILL, "--ambient", "1.2")["sensor Sx ambient light"]
        self.assertEqual(health, "doubtful")
        self.assertIn("1.200 V in the dark phase, 36 % of the range", text)
        self.assertIn("shade the sensor", advice)

    def test_saturation_is_bad(self):
        found = self.examine(*STILL, "--ambient", "3.25", status=1)
        self.assertEqual(found["saturation"][0], "bad")

    def test_a_saturated_sensor_is_named_and_the_other_is_not_blamed(self):
        recording, _ = self.simulate("--seconds", "10", *STILL, rig=RIG.name)
        lines = recording.read_text().splitlines()
        for i, line in enumerate(lines):
            if line[0].isdigit():
                cells = line.split(",")
                lines[i] = ",".join([*cells[:2], "65535", *cells[3:-1], str(int(cells[-1]) | SATURATED)])
        saturated = self.write("saturated.csv", "\n".join(lines) + "\n")
        found = verdicts(run("doctor", f"file:{saturated}", "--rig", RIG, status=1))
        self.assertRegex(found["saturation"][1], r"^(\d+) of \1 samples .*: sensor Sx in \1$")
        self.assertEqual(found["sensor Sx signal"][0], "bad")
        self.assertEqual(found["sensor Sy signal"][0], "good")

    def test_a_pendulum_that_is_not_at_rest_where_the_rig_has_it(self):
        health, text, advice = self.examine("--held", "--theta-deg", "1", "--phi-deg", "45")["sensor Sx gap"]
        self.assertEqual(health, "doubtful")
        self.assertRegex(text, r"its zero is off by -?0\.\d\d deg")
        self.assertIn("penduline calibrate rest", advice)

    def test_a_pendulum_that_something_holds_is_not_to_be_zeroed(self):
        for degrees in (15, 40):
            found = self.examine("--held", "--theta-deg", degrees, rig=RIGS / "paper.toml")
            health, text, advice = found["sensor Sx gap"]
            self.assertEqual(health, "doubtful")
            self.assertRegex(text, r"its zero is off by -\d+\.\d\d deg")
            self.assertIn("whether something holds the pendulum", advice)
            self.assertNotIn("calibrate", "".join(advice for _, _, advice in found.values()))

    def test_a_pendulum_that_swings_is_held_against_neither_zero_nor_noise(self):
        for degrees in (0.3, 10):
            found = self.examine("--theta-deg", degrees)
            health, text, advice = found["pendulum"]
            self.assertEqual(health, "doubtful")
            self.assertRegex(text, r"^it is not at rest: sensor S[xy] sees it swing by \d\.\d\d deg "
                             r"RMS at 0\.\d\d Hz, so neither its zero nor its noise can be judged$")
            self.assertIn("wait until it hangs still", advice)
            self.assertNotIn("zero", found["sensor Sx gap"][1])
            self.assertNotIn("sensor Sx noise", found)

    def test_more_noise_than_the_rig_says(self):
        health, text, advice = self.examine(*STILL, "--gap-noise", "3e-5")["sensor Sx noise"]
        self.assertEqual(health, "doubtful")
        self.assertIn("where the rig says", text)
        self.assertIn("calibrate rest", advice)

    def test_noise_that_hides_a_swing_is_to_be_seen_to_before_the_zero(self):
        found = self.examine("--theta-deg", "0.5", "--noise", "0.3")
        health, text, advice = found["pendulum"]
        self.assertEqual(health, "doubtful")
        self.assertIn("whether it hangs still is hidden by noise", text)
        self.assertIn("look for loose wires", advice)
        self.assertEqual(found["sensor Sx noise"][0], "doubtful")
        self.assertNotIn("zero", found["sensor Sx gap"][1])
        self.assertNotIn("calibrate", "".join(advice for _, _, advice in found.values()))

    def test_doubts_end_with_3_where_strict_asks(self):
        recording, _ = self.simulate("--seconds", "10", *STILL, "--ambient", "1.2")
        run("doctor", f"file:{recording}")
        run("doctor", f"file:{recording}", "--strict", status=3)

    def test_a_simulation_is_no_set_up(self):
        self.assertIn("found sim:, expected a board or a recording", run("doctor", "sim:", status=2).stderr)

    def test_a_word_that_is_no_source_is_told_the_right_ones(self):
        self.write("my still.csv", "")
        forms = "expected auto, serial:PATH, usb:VID:PID or file:PATH"
        there = run("doctor", "my still.csv", status=2, cwd=self.folder).stderr
        self.assertIn(f"found 'my still.csv', {forms}; for that recording: \"file:my still.csv\"\n", there)
        nowhere = run("doctor", "nowhere.csv", status=2, cwd=self.folder).stderr
        self.assertIn(f"found 'nowhere.csv', {forms}\n", nowhere)


if __name__ == "__main__":
    unittest.main()
