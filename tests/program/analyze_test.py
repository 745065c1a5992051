# SPDX-License-Identifier: Apache-2.0
# `penduline analyze`: reports in text and JSON, figures, and what it refuses.
import json
import math
import unittest

from program import RIGS, SHARED_DATA, ProgramTest, run

ENCODER = SHARED_DATA / "dynamicslab_free_swing_200hz.csv"
NEEDS_DATA = unittest.skipUnless(ENCODER.exists(),
                                 "the folder ../shared/data is not beside the repository")


def analyze(path, *options):
    return json.loads(run("analyze", path, "--format", "json", *options).stdout)


def within(figure, truth, sigmas=4):
    return abs(figure["value"] - truth) < sigmas * figure["sigma"]


class AnalyzeTest(ProgramTest):
    def angles(self, angle, seconds=20, rate=50):
        rows = "".join(f"{i / rate:.3f},{angle(i / rate):.9f}\n" for i in range(seconds * rate))
        return self.write("angles.csv", "t_s,theta_rad\n" + rows)

    def test_a_simulated_recording_gives_back_what_was_simulated(self):
        recording, _ = self.simulate("--theta-deg", 15, "--psi", 2, "--seconds", 20, "--gap-noise",
                                     "50e-6")
        report = analyze(recording, "--rig", RIGS / "paper.toml")
        self.assertEqual(report["damping"]["chosen"], ["linear"])
        self.assertTrue(within(report["damping"]["linear_per_s"], 0.01), report["damping"])
        self.assertTrue(within(report["period"]["length_m"], 0.3), report["period"])
        self.assertLess(report["period"]["length_m"]["sigma"], 1e-4)
        self.assertTrue(within(report["period"]["amplitude_coefficient_per_rad2"], 1 / 16))
        # omega0 / damping, for swings that are small.
        self.assertTrue(within(report["damping"]["q_at_start"], math.sqrt(9.8 / 0.3) / 0.01, 5))
        self.assertGreater(report["ellipse"]["semi_minor_rad"]["value"], 0)
        precession = report["precession"]
        self.assertTrue(within(precession["measured_rad_s"], precession["model_rad_s"]["value"]))
        self.assertAlmostEqual(precession["airy_rad_s"] / precession["model_rad_s"]["value"], 1,
                               delta=0.01)
        self.assertLess(abs(report["residuals"]["next_correlation"]), 0.15)
        self.assertAlmostEqual(report["energy"]["mgl_j"], 0.1 * 9.8 * 0.3, places=4)

    def test_estimates_of_a_replay_are_a_table_of_angles(self):
        recording, _ = self.simulate("--theta-deg", 10, "--psi", 1)
        table = self.folder / "estimates.csv"
        run("replay", recording, "--rig", RIGS / "paper.toml", "-o", table)
        report = analyze(table)
        self.assertFalse(report["planar"])
        self.assertAlmostEqual(report["period"]["length_m"]["value"], 0.3, delta=3e-4)

    @NEEDS_DATA
    def test_a_real_pendulums_dry_friction_is_found_and_its_decay_reproduced(self):
        report = analyze(ENCODER)
        damping = report["damping"]
        self.assertIn("dry", damping["chosen"])
        self.assertLess(damping["leaving_out"]["dry"]["probability"], 1e-6)
        without = [model for model in damping["models"] if "dry" not in model["terms"]]
        self.assertFalse(any(model["supported"] for model in without))
        self.assertLess(report["decay"]["max_difference_of_start"], 0.02)
        # It stands still from 6 s on; its last swings count.
        self.assertLess(report["to_s"], 6)
        self.assertGreater(report["to_s"], 4)

    @NEEDS_DATA
    def test_the_same_swing_through_two_sensors_has_the_same_friction_and_direction(self):
        by_encoder = analyze(ENCODER)["damping"]["dry_rad_s2"]
        report = analyze(SHARED_DATA / "real_swing.csv", "--rig", SHARED_DATA / "real_swing_rig.toml")
        by_sensors = report["damping"]["dry_rad_s2"]
        self.assertLess(abs(by_encoder["value"] - by_sensors["value"]),
                        3 * math.hypot(by_encoder["sigma"], by_sensors["sigma"]))
        self.assertTrue(within(report["ellipse"]["orientation_rad"], math.radians(35), 3))

    def test_gravity_follows_from_a_given_length(self):
        omega = 2 * math.pi / 1.1
        table = self.angles(lambda t: 0.01 * math.exp(-0.01 * t) * math.cos(omega * t))
        report = analyze(table, "--length-m", 0.3)
        self.assertAlmostEqual(report["period"]["gravity_m_s2"]["value"], 0.3 * omega ** 2, places=3)
        self.assertTrue(report["planar"])
        self.assertIsNone(report["precession"])

    def test_the_text_says_figures_with_uncertainties_and_units(self):
        recording, _ = self.simulate("--theta-deg", 10, "--psi", 1, "--gap-noise", "50e-6")
        text = run("analyze", recording, "--rig", RIGS / "paper.toml", "--latitude-deg", 48).stdout
        self.assertRegex(text, r"effective length +0\.\d+ \+- 0\.\d+ m \(for gravity 9\.8 m/s2\)")
        self.assertRegex(text, r"supported by the data +linear\n")
        self.assertRegex(text, r"sense +anticlockwise\n")
        self.assertRegex(text, r"Airy, 3/8 omega0 a b +\d")
        self.assertRegex(text, r"the Earth's rotation +-0\.0031 deg/s")

    def test_figures_are_drawn(self):
        recording, _ = self.simulate("--theta-deg", 10, "--psi", 1)
        figure = self.folder / "swing.svg"
        run("analyze", recording, "--rig", RIGS / "paper.toml", "--plot", figure)
        drawn = figure.read_text()
        for title in ("Angles", "Experiment less simulation", "Decay of the amplitude",
                      "Period against amplitude", "The path from above"):
            self.assertIn(title, drawn)

    def test_the_part_between_two_moments_can_be_asked_for(self):
        recording, _ = self.simulate("--theta-deg", 10, "--psi", 1)
        report = analyze(recording, "--rig", RIGS / "paper.toml", "--from-s", 2, "--to-s", 8)
        self.assertGreaterEqual(report["from_s"], 2)
        self.assertLessEqual(report["to_s"], 8)

    def test_a_pendulum_at_rest_is_refused_with_the_reason(self):
        done = run("analyze", self.angles(lambda t: 0.02), status=1)
        self.assertIn("angles.csv: found no swing: the angles do not change", done.stderr)
        self.assertEqual(done.stdout, "")

    def test_a_recording_without_a_rig_is_refused(self):
        recording, _ = self.simulate()
        done = run("analyze", recording, status=1)
        self.assertIn("found no angles; a recording needs --rig", done.stderr)

    def test_the_standard_input_is_refused(self):
        self.assertIn("found the standard input, expected a file",
                      run("analyze", "-", status=1).stderr)

    def test_strict_tells_of_rows_left_out(self):
        omega = 2 * math.pi / 1.1
        table = self.angles(lambda t: 0.1 * math.cos(omega * t))
        table.write_text(table.read_text().replace("\n2.000,", "\n2.000,nan\n2.001,"))
        done = run("analyze", table, "--strict", status=3)
        self.assertIn("angles.csv: 1 of 1001 rows are left out (1 without angles)", done.stderr)

    def test_noise_that_is_larger_than_told_is_named_and_measured_by_a_rest(self):
        # Five times what the rig's sensors say.
        recording, _ = self.simulate("--theta-deg", 10, "--psi", 1, "--gap-noise", "50e-6")
        estimates = self.folder / "estimates.csv"
        noisy = run("replay", recording, "--rig", RIGS / "paper.toml", "--estimator", "ekf", "-o",
                    estimates)
        self.assertRegex(noisy.stderr, r"warning: \d+ of \d+ estimates are disturbed: unless "
                         "something moves the pendulum, noise_v or noise_m of the rig's sensors is too "
                         "small")
        done = run("analyze", estimates, status=1)
        self.assertRegex(done.stderr, r"expected at least \d swings.*; \d+ of \d+ rows are left out "
                         r"\(.*\d+ disturbed\)")
        still, told = self.folder / "still.csv", self.folder / "told.toml"
        run("simulate", "--rig", RIGS / "paper.toml", "--theta-deg", 0, "--gap-noise", "50e-6",
            "--seconds", 120, "-o", still)
        run("calibrate", "rest", still, "--rig", RIGS / "paper.toml", "-o", told)
        run("replay", recording, "--rig", told, "--estimator", "ekf", "-o", estimates)
        self.assertEqual(analyze(estimates)["rows_left_out"], 0)

    def test_wrong_usage_is_refused(self):
        for options in (["--latitude-deg", 91], ["--from-s", "nan"], ["--format", "xml"],
                        ["--length-m", 0.3, "--gravity-m-s2", 9.8]):
            run("analyze", "angles.csv", *options, status=2)


if __name__ == "__main__":
    unittest.main()
