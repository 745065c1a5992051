# SPDX-License-Identifier: Apache-2.0
# `penduline calibrate`: what it writes can be used, what it refuses leaves nothing.
import unittest

from program import RIGS, ProgramTest, read_rows, rms_error_deg, run

TYPICAL = RIGS / "tcrt5000.toml"


class CalibrateTest(ProgramTest):
    def setUp(self):
        super().setUp()
        # The real rig: another gain and a higher sensor than its user believes.
        text = TYPICAL.read_text().replace("-0.011]", "-0.0108]", 1)
        self.real = self.write("real.toml", text.replace(
            "1.22, 1.58, 1.90, 1.85, 1.69, 1.48, 1.26, 0.91, 0.675, 0.515, 0.378, 0.243",
            "1.31, 1.70, 2.04, 1.99, 1.82, 1.59, 1.35, 0.98, 0.726, 0.554, 0.406, 0.261"))
        self.new = self.folder / "new.toml"

    def record(self, name, *arguments):
        path = self.folder / name
        run("simulate", "--rig", self.real, "-o", path, *arguments)
        return path

    def tilts(self):
        """A table of tilts along both axes, each held for a second."""
        rows = ["recording,theta1_deg,theta2_deg"]
        for phi, signs in ((0, (0, -1)), (90, (1, 0)), (180, (0, 1)), (270, (-1, 0))):
            for theta in (0, 3, 6, 9, 12):
                name = f"held_{phi}_{theta}.csv"
                self.record(name, "--held", "--theta-deg", theta, "--phi-deg", phi, "--seconds", 1)
                rows.append(f"{name},{theta * signs[0]},{theta * signs[1]}")
        return self.write("points.csv", "\n".join(rows) + "\n")

    def error_with(self, rig):
        """RMS error in degrees of another recording's angles by a rig."""
        recording, truth = self.folder / "next.csv", self.folder / "truth.csv"
        swing = ("--theta-deg", 11, "--phi-deg", 20, "--psi", 2, "--seed", 5)
        run("simulate", "--rig", self.real, "-o", recording, *swing)
        run("simulate", "--rig", self.real, "-o", "/dev/null", "--truth", truth, "--rate", 200, *swing)
        angles = self.folder / "angles.csv"
        run("replay", recording, "--rig", rig, "-o", angles)
        return rms_error_deg(read_rows(angles), read_rows(truth), from_s=1)

    def test_static_points_make_the_angles_right(self):
        self.assertGreater(self.error_with(TYPICAL), 0.5)
        done = run("calibrate", "static", "--points", self.tilts(), "--rig", TYPICAL, "-o", self.new,
                   "--strict")
        self.assertLess(self.error_with(self.new), 0.1)
        self.assertIn("calibration: static, residual ", done.stdout)
        self.assertIn('method = "static"', self.new.read_text())
        self.assertIn(f'"{self.folder}/held_0_3.csv"', self.new.read_text())

    def test_a_free_swing_makes_the_angles_right_and_draws_its_fit(self):
        swing = self.record("swing.csv", "--theta-deg", 12, "--phi-deg", 30, "--psi", 2.5,
                            "--seconds", 40)
        plot = self.folder / "fit.svg"
        done = run("calibrate", "swing", swing, "--rig", TYPICAL, "-o", self.new, "--plot", plot)
        self.assertLess(self.error_with(self.new), 0.3)
        self.assertIn("effective length", done.stdout)
        self.assertIn("Sx: residuals", plot.read_text())

    def test_a_known_release_makes_the_angles_right(self):
        swing = self.record("swing.csv", "--theta-deg", 14, "--phi-deg", 45, "--seconds", 20)
        # 14 deg towards 45 deg: z = cos 14, x = y = sin 14 / sqrt 2.
        run("calibrate", "swing", swing, "--released-at", "9.9986,-9.8498", "--rig", TYPICAL,
            "-o", self.new)
        self.assertLess(self.error_with(self.new), 0.3)

    def test_a_rest_zeroes_the_angles(self):
        still = self.record("still.csv", "--theta-deg", 0)
        done = run("calibrate", "rest", still, "--rig", TYPICAL, "-o", self.new)
        self.assertIn("the rig as it was gives theta1 = ", done.stdout)
        angles = self.folder / "angles.csv"
        run("replay", still, "--rig", self.new, "-o", angles)
        last = read_rows(angles)[-1]
        self.assertLess(abs(float(last["theta1_rad"])), 1e-3)
        self.assertLess(abs(float(last["theta2_rad"])), 1e-3)

    def test_a_geometry_says_what_it_could_not_tell(self):
        still = self.record("still.csv", "--held", "--theta-deg", 0)
        points = self.write("one.csv", f"recording,theta1_deg,theta2_deg\n{still.name},0,0\n")
        done = run("calibrate", "geometry", "--points", points, "--rig", TYPICAL, "-o", self.new)
        self.assertIn("not determined by these data, left as in the rig: disc offset_m, Sx y_m, Sx x_m",
                      done.stdout)
        self.assertIn("not_determined = ", self.new.read_text())

    def test_a_geometry_by_a_swing_that_leaves_samples_out_warns_and_strict_tells(self):
        swing = self.record("swing.csv", "--theta-deg", 12, "--phi-deg", 30, "--psi", 2.5)
        rig = self.write("short.toml", self.real.read_text().replace(
            'model = "table"', 'model = "table", range_m = [0.003, 0.0125]', 1))
        done = run("calibrate", "geometry", swing, "--rig", rig, "-o", self.new, "--strict", status=3)
        self.assertRegex(done.stderr, r"warning: sensor Sx: \d+ of 200 samples are left out: they are "
                         r".*or not at 3\.00 to 12\.50 mm, where its response holds\n")
        self.assertTrue(self.new.exists())

    def test_points_in_the_fold_are_warned_of_and_strict_tells(self):
        gaps = (1.0, 1.6, 2.2, 2.6, 3.2, 4, 5, 6, 8, 10, 12, 14)
        rows = ["from_s,to_s,gap_x_mm,gap_y_mm"]
        lines = ["# penduline_recording = 1", "# rate_hz = 20.0", "# full_scale_counts = 65535",
                 "# reference_v = 3.3", "seq,t_us,x_on,x_off,y_on,y_off,flags"]
        for i, gap in enumerate(gaps):
            # A response that peaks at 2.4 mm.
            volts = 8 / ((max(gap, 2.4) + 0.4) ** 1.5) if gap > 2.4 else 1.7 - 0.2 * (2.4 - gap)
            counts = round(volts / 3.3 * 65535)
            rows.append(f"{i}.0,{i}.9,{gap},{gap}")
            lines += [f"{20 * i + k},{(20 * i + k) * 50000},{counts + k % 2},0,{counts},0,0"
                      for k in range(20)]
        recording = self.write("rec.csv", "\n".join(lines) + "\n")
        points = self.write("spans.csv", "\n".join(rows) + "\n")
        done = run("calibrate", "static", recording, "--points", points, "--rig", TYPICAL, "-o",
                   self.new, "--strict", status=3)
        self.assertIn("warning: sensor Sx: 4 of 12 points are nearer than 3.00 mm and left out: the "
                      "signal folds back at its peak at 2.40 mm", done.stderr)

    def test_strict_counts_what_the_recordings_complain_of_as_a_replay_does(self):
        lines = self.record("whole.csv", "--held", "--theta-deg", 0).read_text().splitlines(True)
        table = f"recording,theta1_deg,theta2_deg\n{self.folder}/rec.csv,0,0\n"
        points = self.write("points.csv", table)
        methods = (["rest", "rec.csv"], ["geometry", "--points", points])
        for fault, warning in (([], None), (lines[50:53], "flagged: 1 dropout"),
                               (lines[-1:], "")):
            kept = [line for line in lines if line not in fault]
            if fault == lines[-1:]:
                kept.append(lines[-1][:8])  # cut off
            recording = self.write("rec.csv", "".join(kept))
            status = 3 if fault else 0
            for method, *arguments in methods:
                with self.subTest(method=method, warning=warning):
                    arguments = [recording if each == "rec.csv" else each for each in arguments]
                    done = run("calibrate", method, *arguments, "--rig", TYPICAL, "-o", self.new,
                               "--force", "--strict", status=status)
                    self.assertEqual("warning: " in done.stderr, status == 3, done.stderr)
                    self.assertIn(warning or "", done.stderr)
            run("replay", recording, "--rig", TYPICAL, "-o", "/dev/null", "--strict", status=status)

    def test_a_noisy_pendulum_that_hangs_still_is_at_rest(self):
        for seed in (5, 6):  # of which noise was once taken for motion
            still = self.record("still.csv", "--held", "--theta-deg", 0, "--seconds", 20,
                                "--gap-noise", 50e-6, "--seed", seed)
            run("calibrate", "rest", still, "--rig", TYPICAL, "-o", self.new, "--force")

    def test_a_swinging_pendulum_has_no_rest(self):
        swing = self.record("swing.csv", "--theta-deg", 5)
        done = run("calibrate", "rest", swing, "--rig", TYPICAL, "-o", self.new, status=1)
        self.assertIn("the pendulum is not still: sensor Sx sees it move (RMS) by ", done.stderr)
        self.assertFalse(self.new.exists())

    def test_a_planar_swing_does_not_determine_the_angles(self):
        swing = self.record("swing.csv", "--theta-deg", 12, "--phi-deg", 45, "--seconds", 20)
        done = run("calibrate", "swing", swing, "--rig", TYPICAL, "-o", self.new, status=1)
        self.assertIn("or release it at an angle that you know (--released-at)", done.stderr)
        self.assertFalse(self.new.exists())

    def test_a_rig_that_is_there_is_kept_unless_forced(self):
        still = self.record("still.csv", "--theta-deg", 0)
        rig = self.write("rig.toml", TYPICAL.read_text())
        done = run("calibrate", "rest", still, "--rig", rig, "-o", rig, status=1)
        self.assertEqual(done.stderr, f"error: {rig}: is there already, expected a new file; --force "
                         "writes over it\n")
        self.assertEqual(rig.read_text(), TYPICAL.read_text())
        done = run("calibrate", "rest", still, "--rig", rig, "-o", still, "--force", status=1)
        self.assertIn("stands for two files of this run", done.stderr)
        run("calibrate", "rest", still, "--rig", rig, "-o", rig, "--force")
        self.assertIn('method = "rest"', rig.read_text())

    def test_wrong_usage_is_said(self):
        for arguments, message in (
                (["rest"], "FILE"), ([], "subcommand"),
                (["swing", "a.csv", "--released-at", "many"], "--released-at: found 'many', expected"),
                (["swing", "a.csv", "--released-at", "0"], "--released-at: found '0', expected a tilt"),
                (["geometry"], "--points")):
            if arguments:
                arguments += ["--rig", TYPICAL, "-o", self.new]
            with self.subTest(arguments=arguments):
                done = run("calibrate", *arguments, status=2)
                self.assertIn(message, done.stderr)

    def test_each_method_teaches_an_example(self):
        for method in ("static", "rest", "swing", "geometry"):
            self.assertIn(f"  penduline calibrate {method} ", run("calibrate", method, "--help").stdout)


if __name__ == "__main__":
    unittest.main()
