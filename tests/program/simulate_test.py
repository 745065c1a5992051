# SPDX-License-Identifier: Apache-2.0
# `penduline simulate`: starts, integrators, determinism, and angles that come back from it.
import math
import unittest

from program import RIGS, ProgramTest, read_rows, rms_error_deg, run


class SimulateTest(ProgramTest):
    def test_case_1_starts_as_the_paper_says(self):
        _, truth = self.simulate("--case", "1")
        first = read_rows(truth)[0]
        # theta = 10 deg, phi = 45 deg: x = l sin(theta) cos(phi), paper Eqs. 1 to 3, Z up.
        self.assertAlmostEqual(float(first["x_m"]), 0.3 * math.sin(math.radians(10)) / math.sqrt(2),
                               places=8)
        self.assertAlmostEqual(float(first["y_m"]), float(first["x_m"]), places=8)
        self.assertAlmostEqual(float(first["z_m"]), -0.3 * math.cos(math.radians(10)), places=8)

    def test_cases_last_as_long_as_the_papers(self):
        for case, samples in (("1", 200), ("2", 1000)):
            recording, _ = self.simulate("--case", case)
            self.assertEqual(len(read_rows(recording)), samples)

    def test_the_conical_swing_keeps_its_height(self):
        rig = self.write("rig.toml",
                         (RIGS / "paper.toml").read_text().replace("damping_per_s = 0.01", ""))
        _, truth = self.simulate("--case", "conical", rig=rig)
        heights = [float(row["z_m"]) for row in read_rows(truth)]
        self.assertLess(max(heights) - min(heights), 2e-9)

    def test_one_seed_gives_one_recording(self):
        first = self.simulate("--seed", 7)[0].read_bytes()
        self.assertEqual(self.simulate("--seed", 7)[0].read_bytes(), first)
        self.assertNotEqual(self.simulate("--seed", 8)[0].read_bytes(), first)

    def test_euler_as_printed_says_that_it_has_blown_up(self):
        done = run("simulate", "--case", 1, "--integrator", "euler", "--rig", RIGS / "paper.toml")
        self.assertIn("warning: sim: the integrator has blown up: by t = 0.450 s the energy has "
                      "doubled", done.stderr)

    def test_euler_in_case_2_ends_where_no_angles_are_left(self):
        done = run("simulate", "--case", 2, "--integrator", "euler", "--rig", RIGS / "paper.toml",
                   status=1)
        self.assertIn("error: sim: no angles any more at t = 0.500 s: the integrator has "
                      "run away", done.stderr)
        self.assertIn("warning: sim: the integrator has blown up", done.stderr)
        self.assertTrue(done.stdout.endswith("\n"))

    def test_numbers_that_are_none_are_wrong_usage(self):
        for option in ("--seconds", "--rate", "--noise", "--gap-noise", "--ambient", "--theta-deg",
                       "--phi-deg", "--omega", "--psi", "--conversions"):
            for number in ("nan", "inf", "1e30", "many"):
                with self.subTest(option=option, number=number):
                    done = run("simulate", "--rig", RIGS / "paper.toml", option, number, status=2)
                    self.assertIn(f"{option}: found {number}, expected a number from ", done.stderr)

    def test_starts_that_the_equations_do_not_have_are_wrong_usage(self):
        for start in (["--case", "conical", "--theta-deg", 90],
                      ["--integrator", "euler", "--theta-deg", 0]):
            done = run("simulate", "--rig", RIGS / "paper.toml", *start, status=2)
            self.assertIn("--theta-deg: ", done.stderr)

    def test_wrong_usage_leaves_an_old_output_as_it_is(self):
        old = self.write("old.csv", "precious")
        run("simulate", "--rig", RIGS / "paper.toml", "--case", "conical", "--theta-deg", 95, "-o", old,
            status=2)
        self.assertEqual(old.read_text(), "precious")

    def test_two_outputs_in_one_new_file_are_refused(self):
        done = run("simulate", "--rig", RIGS / "paper.toml", "-o", self.folder / "new.csv", "--truth",
                   f"{self.folder}/./new.csv", status=1)
        self.assertIn("stands for two files of this run", done.stderr)

    def test_angles_come_back_from_tcrt5000_sensors_with_noise_and_ambient_light(self):
        swing = ("--theta-deg", 10, "--psi", 3)
        _, truth = self.simulate(*swing, "--rate", 200, rig="tcrt5000.toml")
        fine_truth = read_rows(truth)
        recording, _ = self.simulate(*swing, rig="tcrt5000.toml")
        angles = self.folder / "angles.csv"
        run("replay", recording, "--rig", RIGS / "tcrt5000.toml", "--strict", "-o", angles)
        self.assertLess(rms_error_deg(read_rows(angles), fine_truth), 0.1)

    def test_a_swing_too_near_to_the_sensors_is_flagged_as_folded(self):
        recording, _ = self.simulate("--theta-deg", 30, "--phi-deg", 0, "--ideal", rig="tcrt5000.toml")
        done = run("replay", recording, "--rig", RIGS / "tcrt5000.toml", "--strict", status=3)
        self.assertIn("[folded]", done.stderr)

    def test_saturation_is_flagged(self):
        recording, _ = self.simulate("--ambient", 2.5)
        done = run("replay", recording, "--rig", RIGS / "paper.toml", "--strict", status=3)
        self.assertIn("[saturated]", done.stderr)

    def test_a_wrong_rig_is_refused_with_its_line(self):
        rig = self.write("rig.toml", (RIGS / "paper.toml").read_text().replace(
            "length_m = 0.3", "length_m = -0.3"))
        done = run("simulate", "--rig", rig, status=1)
        self.assertEqual(done.stderr, f"error: {rig}:3: [pendulum] length_m: found -0.3, expected a "
                         "number above 0\n")


if __name__ == "__main__":
    unittest.main()
