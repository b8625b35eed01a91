"""A whole mission through saker-mavlink: the simulated aircraft behind ArduPilot's or PX4's side of MAVLink."""

import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCENARIO = """kind: mission
mission:
  site: {street_m: 80, parked_share: 0.35, targets: 1, prior_sd_m: 0.3}
  wind: {mean_mps: 1, gust_mps: 0.3}
  capture: {rows: 64, columns: 512}
"""


@unittest.skipUnless(os.environ.get("SAKER_NAMESPACE") == "yes", "runs by in_namespace.sh")
class Flight(unittest.TestCase):
    def fly(self, autopilot):
        holder = tempfile.TemporaryDirectory(prefix="saker_mavlink_")
        self.addCleanup(holder.cleanup)
        out = pathlib.Path(holder.name)
        (out / "one.yaml").write_text(SCENARIO)
        run = subprocess.run([ROOT / "scripts/fly", out / "one.yaml", out, "1", "--mavlink", autopilot, "--preset", "visit"],
                             capture_output=True, text=True, stdin=subprocess.DEVNULL)
        self.simulator, self.bridge = ((out / f"{name}.log").read_text() for name in ("saker-sim", "saker-mavlink"))
        self.text = f"{run.stderr}\n{self.simulator}\n{self.bridge}"
        self.assertEqual(run.returncode, 0, self.text)
        self.sim = json.loads((out / "simulator/sim.json").read_text())
        self.results = json.loads((out / "report/results.json").read_text())

    def flies_whole(self, autopilot, guided, land):
        self.fly(autopilot)
        self.assertTrue(self.sim["landed"], self.text)
        self.assertEqual(self.sim["collisions"], 0, self.text)
        self.assertEqual((self.results["found"], self.results["targets"]), (1, 1), self.text)
        modes = re.findall(r"autopilot: mode (\d+)", self.simulator)
        self.assertIn(str(guided), modes)
        self.assertEqual(modes[-1], str(land), "it lands as ordered, by no failsafe")
        self.assertIn(f"{autopilot} is system 1, armed", self.bridge)
        self.assertNotIn("odometry is lost", self.bridge)

    def test_ardupilot(self):
        self.flies_whole("ardupilot", 4, 9)

    def test_px4(self):
        self.flies_whole("px4", 6 << 16, 4 << 16 | 6 << 24)


if __name__ == "__main__":
    unittest.main(argv=sys.argv)
