"""One recording of the simulator in every format gives one map: the same bytes where times, points and inertial samples survive
the format, else the same objects within a bound."""

import json
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
PLACE_M, SIZE_M = 0.10, 0.10  # between an organised recording and points in a list, with and without inertial samples


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
        one, other = (json.loads(m)["objects"] for m in (one, other))
        self.assertEqual(len(one), len(other), name)
        for a in one:
            b = min(other, key=lambda o: sum((p - q) ** 2 for p, q in zip(place(a), place(o))))
            self.assertEqual(a["class"], b["class"], name)
            for p, q in zip(place(a), place(b)):
                self.assertAlmostEqual(p, q, delta=PLACE_M, msg=name)
            for p, q in zip(a.get("size", []), b.get("size", [])):
                self.assertAlmostEqual(p, q, delta=SIZE_M, msg=name)

    def test_one_map(self):
        ros1 = self.map_of(self.folder / "ros1.bag")
        self.assertGreater(len(json.loads(ros1)["objects"]), 0)
        self.assertEqual(ros1, self.map_of(self.folder / "ros2.db3"))
        self.assertEqual(ros1, self.map_of(self.folder / "mcap.mcap"))
        plain = self.map_of(self.folder / "plain.bag")
        self.assertEqual(plain, self.map_of(self.folder / "pcd"))
        self.assert_same_objects(plain, self.map_of(self.folder / "bin"), "bin")
        self.assert_same_objects(ros1, plain, "without inertial samples")
        self.assert_same_objects(ros1, self.map_of(self.capture), "capture")


if __name__ == "__main__":
    unittest.main()
