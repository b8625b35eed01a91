"""One recording of the simulator in every format gives one map: the same bytes where times, points and inertial samples survive
the format, else the same objects within a bound."""

import json
import math
import os
import subprocess
import unittest

from program import ProgramTest, saker

FLIGHT = """kind: flight
flight:
  duration_s: 3
  speed_mps: 1.0
  height_m: 3.4
  capture: {profile: RNG19_RFL8_SIG16_NIR16, rows: 64, columns: 1024}
"""
PLACE_M, SIZE_M = 0.10, 0.10  # with and without inertial samples, and with times as float32
LEAST_SHARE = 0.75  # of the objects, between the sensor's own columns and points in a list


def place(mapped):
    return mapped["position" if "position" in mapped else "root"][:2]


class FormatsMap(ProgramTest):
    def setUp(self):
        super().setUp()
        scenario, made = self.folder / "flight.yaml", self.folder / "made"
        scenario.write_text(FLIGHT)
        run = saker("simulate-scans", scenario, "-o", made, "--seed", 5)
        self.assertEqual(run.returncode, 0, run.stderr)
        (self.capture,) = made.rglob("*.pcap")
        subprocess.run([os.environ["MADE_FORMATS"], self.capture, self.folder], check=True, timeout=60)

    def map_of(self, recording):
        out = self.folder / "out" / recording.name
        run = saker("replay", recording, "-o", out)
        self.assertEqual(run.returncode, 0, f"{recording.name}: {run.stderr}")
        return (out / "map.json").read_bytes()

    def assert_same_objects(self, one, other, name):
        """Those that every window saw; others may be in one alone."""
        one, other = (json.loads(m)["objects"] for m in (one, other))
        windows = max(o["observations"] for o in one + other)
        for some, among in ((one, other), (other, one)):
            seen = [o for o in some if o["observations"] == windows]
            self.assertGreater(len(seen), len(some) / 2, name)
            for a in seen:
                b = min(among, key=lambda o: math.dist(place(a), place(o)))
                self.assertEqual(a["class"], b["class"], name)
                for p, q in zip(place(a), place(b)):
                    self.assertAlmostEqual(p, q, delta=PLACE_M, msg=name)
                for p, q in zip(a.get("size", []), b.get("size", [])):
                    self.assertAlmostEqual(p, q, delta=SIZE_M, msg=name)

    def assert_alike(self, one, other, name):
        """Objects near the bound of what is in a map may be in one alone."""
        one, other = (json.loads(m)["objects"] for m in (one, other))
        found = sum(any(a["class"] == b["class"] and math.dist(place(a), place(b)) < PLACE_M for b in other) for a in one)
        self.assertGreaterEqual(found, LEAST_SHARE * max(len(one), len(other)), f"{name}: {found} of {len(one)}, {len(other)}")

    def test_one_map(self):
        ros1 = self.map_of(self.folder / "ros1.bag")
        self.assertGreater(len(json.loads(ros1)["objects"]), 0)
        self.assertEqual(ros1, self.map_of(self.folder / "ros2.db3"))
        self.assertEqual(ros1, self.map_of(self.folder / "mcap.mcap"))
        plain = self.map_of(self.folder / "plain.bag")
        self.assertEqual(plain, self.map_of(self.folder / "pcd"))
        self.assert_same_objects(plain, self.map_of(self.folder / "bin"), "bin")
        self.assert_same_objects(ros1, plain, "without inertial samples")
        self.assert_alike(ros1, self.map_of(self.capture), "capture")


if __name__ == "__main__":
    unittest.main()
