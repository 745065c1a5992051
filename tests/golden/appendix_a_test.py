# SPDX-License-Identifier: Apache-2.0
# The estimator `paper` against an independent script of Appendix A and the paper's known errors.
import math
import pathlib
import subprocess
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "program"))
from program import RIGS, ProgramTest, read_rows, rms_error_deg, run  # noqa: E402

SCRIPT = pathlib.Path(__file__).with_name("appendix_a.py")
DROPPED_SAMPLES = 28


class AppendixATest(ProgramTest):
    def estimates(self, recording, *arguments):
        path = self.folder / "estimates.csv"
        run("replay", recording, "--rig", RIGS / "paper.toml", "--estimator", "paper", *arguments,
            "-o", path)
        return read_rows(path)

    def assert_equals_script(self, *simulation):
        recording, _ = self.simulate(*simulation)
        golden = subprocess.run(
            [sys.executable, SCRIPT, recording, "--scale1", "0.006", "--scale2", "0.006"],
            capture_output=True, text=True, check=True)
        path = self.write("golden.csv", golden.stdout)
        expected = {row["seq"]: row for row in read_rows(path)}
        found = self.estimates(recording)
        self.assertEqual(len(found) - DROPPED_SAMPLES, len(expected))
        for row in found[DROPPED_SAMPLES:]:
            for ours, theirs in (("theta1_rad", "theta1_rad"), ("theta2_rad", "theta2_rad"),
                                 ("x_m", "cx_m"), ("y_m", "cy_m"), ("z_m", "cz_m")):
                difference = abs(float(row[ours]) - float(expected[row["seq"]][theirs]))
                self.assertLess(difference, 1e-6, f"{ours} of seq {row['seq']}")

    def test_equals_the_script_sample_by_sample_in_case_1(self):
        self.assert_equals_script("--case", "1", "--ideal")

    def test_equals_the_script_sample_by_sample_in_a_conical_swing(self):
        self.assert_equals_script("--case", "conical", "--ideal")

    def test_equals_the_script_sample_by_sample_with_noise_and_ambient_light(self):
        self.assert_equals_script("--case", "1", "--noise", "0.05")

    def test_is_7_9_deg_off_as_printed_and_0_80_deg_after_alignment(self):
        # shared/paper/reading.md, "Facts to build on": case 1, perfect linear sensors.
        recording, truth_path = self.simulate("--case", "1", "--ideal")
        truth = read_rows(truth_path)
        self.assertAlmostEqual(rms_error_deg(self.estimates(recording), truth), 7.9, delta=0.02)
        aligned = self.estimates(recording, "--align")
        self.assertAlmostEqual(rms_error_deg(aligned, truth), 0.80, delta=0.01)

    def test_is_0_84_deg_off_after_alignment_where_the_truth_is_not_interpolated(self):
        recording, _ = self.simulate("--case", "1", "--ideal")
        aligned = self.estimates(recording, "--align")
        # The rows refer to moments between two samples; at 40 Hz the truth has them.
        _, truth_path = self.simulate("--case", "1", "--ideal", "--rate", "40")
        self.assertAlmostEqual(rms_error_deg(aligned, read_rows(truth_path)), 0.844, delta=0.002)

    def test_gn_on_the_same_samples_keeps_the_amplitude(self):
        _, truth_path = self.simulate("--case", "1", "--ideal", "--rate", "40")
        truth = read_rows(truth_path)
        recording, _ = self.simulate("--case", "1", "--ideal")
        path = self.folder / "gn.csv"
        run("replay", recording, "--rig", RIGS / "paper.toml", "-o", path)
        # 1 % of a 7.1 deg amplitude is 0.05 deg RMS.
        self.assertLess(rms_error_deg(read_rows(path), truth), 0.05)
        self.assertTrue(all(math.isfinite(float(row["t_s"])) for row in read_rows(path)))


if __name__ == "__main__":
    unittest.main()
