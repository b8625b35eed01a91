"""One short mission among obstacles, as `saker experiment` flies it."""

import unittest

from missions import fly
from program import ProgramTest


class ShortMission(ProgramTest):
    def test_all_targets_are_found_without_a_collision(self):
        results = fly("small", self.folder / "out", "--policy", "saker")
        self.assertTrue(results["succeeded"], results["outcome"])
        self.assertEqual(results["found"], results["targets"])
        self.assertEqual(results["collisions"], 0)
        self.assertGreater(results["min_clearance_m"], 0)
        self.assertLess(results["trajectory_error_m"], 0.3)
        self.assertLess(results["mae_m"], 0.25)


if __name__ == "__main__":
    unittest.main()
