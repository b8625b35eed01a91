"""`--record`: scans of a run in an MCAP file, which `saker replay` reads again."""

import json
import math
import unittest
import xml.etree.ElementTree

from program import ProgramTest, saker

FLIGHT = """kind: flight
flight:
  duration_s: 2
  speed_mps: 1.0
  height_m: 3.4
  capture: {rows: 64, columns: 512}
"""
PLACE_M = 0.05  # of the last pose: the recording holds no inertial samples


def last_place(out):
    return [float(word) for word in (out / "trajectory.txt").read_text().splitlines()[-1].split()[1:4]]


class Record(ProgramTest):
    def setUp(self):
        super().setUp()
        scenario, made = self.folder / "flight.yaml", self.folder / "made"
        scenario.write_text(FLIGHT)
        run = saker("simulate-scans", scenario, "-o", made, "--seed", 5)
        self.assertEqual(run.returncode, 0, run.stderr)
        (self.capture,) = made.rglob("*.pcap")

    def test_a_recorded_replay_is_replayed_with_all_its_scans(self):
        first, second, file = self.folder / "first", self.folder / "second", self.folder / "run.mcap"
        run = saker("replay", self.capture, "-o", first, "--record", file)
        self.assertLessEqual(run.returncode, 1, run.stderr)
        self.assertIn("report.html", run.stderr.splitlines()[-1])
        again = saker("replay", file, "-o", second)
        self.assertLessEqual(again.returncode, 1, again.stderr)
        scans = [json.loads((out / "results.json").read_text())["scans"] for out in (first, second)]
        self.assertGreater(scans[0], 10)
        self.assertEqual(*scans)
        self.assertLess(math.dist(last_place(first), last_place(second)), PLACE_M)
        page = xml.etree.ElementTree.parse(first / "report.html").getroot()
        self.assertTrue(page.tag.endswith("html"))
        self.assertTrue(any(node.tag.endswith("svg") for node in page.iter()))
        self.assertIn("is there", self.refused("replay", self.capture, "-o", self.folder / "third", "--record", file))


if __name__ == "__main__":
    unittest.main()
