# SPDX-License-Identifier: Apache-2.0
# A real pendulum's swing, seen through two TCRT5000 curves, against its encoder's truth.
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "program"))
from program import SHARED_DATA, ProgramTest, read_rows, rms_error_deg, run  # noqa: E402


@unittest.skipUnless(SHARED_DATA.is_dir(), "the folder ../shared/data is not beside the repository")
class RealSwingTest(ProgramTest):
    def rms_deg(self, estimator):
        """After the first second; no row may be flagged."""
        path = self.folder / "angles.csv"
        run("replay", SHARED_DATA / "real_swing.csv", "--rig", SHARED_DATA / "real_swing_rig.toml",
            "--estimator", estimator, "--strict", "-o", path)
        estimates = read_rows(path)
        truth = read_rows(SHARED_DATA / "real_swing_truth.csv")
        self.assertEqual(len(estimates), len(truth))
        return rms_error_deg(estimates, truth, from_s=1.0)

    def test_gn_is_within_0_12_deg_of_the_encoder_after_the_first_second(self):
        self.assertLess(self.rms_deg("gn"), 0.12)

    def test_ekf_is_within_0_045_deg_although_the_damping_is_not_linear(self):
        self.assertLess(self.rms_deg("ekf"), 0.045)

    def test_the_smoother_is_within_0_03_deg(self):
        self.assertLess(self.rms_deg("smoother"), 0.03)


if __name__ == "__main__":
    unittest.main()
