"""An overhead robot's rough map is all that two low robots know of the site: `saker mission`, some minutes of CPU."""

import json
import unittest

from program import ROOT, ProgramTest, saker

MISSION = ROOT / "configs" / "missions" / "overhead.yaml"


def vehicles(file):
    return [o for o in json.loads(file.read_text())["objects"] if o["class"] == "vehicle"]


class OverheadMission(ProgramTest):
    def test_low_robots_find_by_the_overhead_map_what_they_were_not_told_beforehand(self):
        out = self.folder / "out"
        run = saker("mission", MISSION, "-o", out, timeout=3600)
        self.assertIn(run.returncode, (0, 1), run.stderr)
        print(run.stdout, flush=True)
        results = json.loads((out / "results.json").read_text())
        overhead, *low = results["robots"]
        self.assertEqual(vehicles(out / "prior.json"), [])
        self.assertEqual(vehicles(out / "OVERHEAD" / "prior.json"), [])
        self.assertGreaterEqual(overhead["found"], overhead["targets"] / 2)
        for robot in results["robots"]:
            self.assertTrue(robot["succeeded"], robot["outcome"])
            self.assertEqual(robot["collisions"], 0)
        for robot in low:
            self.assertNotEqual(vehicles(out / robot["robot"] / "prior.json"), [])
            self.assertGreaterEqual(robot["found"], overhead["found"] - 1)
        self.assertLess(results["merged"]["mae_m"], 0.25)


if __name__ == "__main__":
    unittest.main()
