# SPDX-License-Identifier: Apache-2.0
# The bench itself: what goes wrong in the guest, however badly, never looks like a pass.
import unittest

import guest


def setUpModule():
    if (reason := guest.missing()) is not None:
        raise unittest.SkipTest(reason)


class OutcomeTest(unittest.TestCase):
    def outcome(self, how, **options):
        return guest.boot(f"tests/kernel/guest/outcome.sh {how}", **options).outcome

    def test_a_program_that_passes_passes(self):
        self.assertEqual(self.outcome("pass"), "passed")

    def test_a_program_that_fails_fails(self):
        self.assertEqual(self.outcome("fail"), "failed")

    def test_a_panic_is_no_pass(self):
        self.assertEqual(self.outcome("panic"), "stopped")

    def test_a_program_that_hangs_is_ended(self):
        self.assertEqual(self.outcome("hang", limit_s=6), "timed out")

    def test_a_machine_that_does_not_start_is_no_pass(self):
        self.assertEqual(self.outcome("pass", options=("-no-such-option",)), "stopped")


if __name__ == "__main__":
    unittest.main()
