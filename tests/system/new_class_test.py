"""A class that no code knows, `bin`, a small cuboid: added by configuration and data alone."""

import json
import math
import random
import re
import struct
import unittest

from made_network import write_network
from program import ROOT, ProgramTest, saker

CLASSES = ["other", "vehicle", "trunk", "pole", "ground", "bin"]
SHAPES = ["none", "cuboid", "cylinder", "cylinder", "plane", "cuboid"]
SIZES = [(1.2, 0.9), (1.35, 1.0), (1.1, 0.75)]  # m, of one recording's bins
PLACES = [(0, 0, 0.3), (1.5, 6, 2.0), (-5, 2, -1.1)]  # x, y, heading
HEIGHT = 1.1  # m, of a bin
FRONT_BIAS, SIDE_BIAS = -0.3, -0.1  # m, of the length by where it is seen from
NOISE = 0.02  # m
RECORDINGS = 6


def configuration(network):
    classes = [{"name": name, "shape": shape, "target": shape == "cuboid", "label_ids": [i + 1]}
               for i, (name, shape) in enumerate(zip(CLASSES, SHAPES))]
    return json.dumps({"objects": {"classes": classes}, "segmentation": {"model": str(network)}})


def quaternion(yaw):
    return [0, 0, math.sin(yaw / 2), math.cos(yaw / 2)]


def bias(angle):
    return FRONT_BIAS if abs(math.cos(angle)) > math.cos(math.radians(30)) else SIDE_BIAS


def eyes():
    """Where the sensor stood: two circles around the bins."""
    return [(r * math.cos(t), r * math.sin(t)) for r in (6, 9) for t in
            (2 * math.pi * (k + 0.5) / 24 for k in range(24))]


class NewClass(ProgramTest):
    def setUp(self):
        super().setUp()
        self.config = self.folder / "bins.yaml"
        self.config.write_text(configuration(write_network(self.folder, CLASSES)))

    def saker(self, *arguments, status=0):
        run = saker(*arguments, "--config", self.config)
        self.assertEqual(run.returncode, status, run.stderr)
        return run

    def recording(self, name, rng):
        """As `saker replay` leaves it; the map's sizes are wrong, the dimensions' are not."""
        run = self.folder / name
        run.mkdir()
        bins = [{"id": i, "class": "bin", "probability": 1, "observations": 48, "position": [x, y, HEIGHT / 2],
                 "rotation": quaternion(yaw), "size": [2, 2, HEIGHT]} for i, (x, y, yaw) in enumerate(PLACES)]
        (run / "map.json").write_text(json.dumps({"frame": "world", "objects": bins, "ground": []}))
        poses, detections = [], []
        for t, (x, y) in enumerate(eyes()):
            poses.append(f"{t}.000000 {x} {y} 2 0 0 0 1\n")
            detections += [json.dumps(self.detection(t, (x, y), place, size, rng)) + "\n"
                           for place, size in zip(PLACES, SIZES)]
        (run / "trajectory.txt").write_text("".join(poses))
        (run / "detections.jsonl").write_text("".join(detections))
        return run

    def detection(self, time, eye, place, size, rng):
        x, y, yaw = place
        seen_from = math.atan2(eye[1] - y, eye[0] - x) - yaw
        length = size[0] + bias(seen_from) + rng.gauss(0, NOISE)
        model = {"position": [x - eye[0] + rng.gauss(0, NOISE), y - eye[1] + rng.gauss(0, NOISE), HEIGHT / 2 - 2],
                 "rotation": quaternion(yaw), "size": [length, size[1] + rng.gauss(0, NOISE), HEIGHT]}
        return {"time": time, "class": "bin", "class_probability": [0.05, 0.05, 0, 0, 0, 0.9], "model": model,
                "points": 60, "moving": False, "covariance": []}

    def collected(self):
        rng = random.Random(1)
        runs = [self.recording(f"yard{i}", rng) for i in range(RECORDINGS)]
        rows = [f"  - {{recording: {run.name}, id: {i}, kind: waste, length_m: {size[0]}, width_m: {size[1]}}}\n"
                for run in runs for i, size in enumerate(SIZES)]
        table = self.folder / "dimensions.yaml"
        table.write_text("objects:\n" + "".join(rows))
        samples = self.folder / "samples.csv"
        self.saker("characterise", "collect", *runs, "--dimensions", table, "-o", samples)
        return samples

    def fitted(self):
        """Model file of the shipped classes and of bins, whose detection leans inward."""
        model = self.folder / "uncertainty.yaml"
        run = self.saker("characterise", "fit", self.collected(), "--add-to", ROOT / "configs/models/uncertainty.yaml",
                         "--data", "six yards", "-o", model, "--set", "fit.cuboid_bias=true")
        self.assertIn(f"bin: {RECORDINGS * len(SIZES)} objects in {RECORDINGS} recordings", run.stdout)
        return model

    def test_is_characterised_and_flown_without_a_line_of_code(self):
        model = self.fitted()
        self.assert_known(model)
        self.assert_starts(model)
        self.assert_needed_where_views_are_chosen(model)

    def test_is_fitted_as_configured(self):
        samples = self.collected()
        model = self.folder / "near.yaml"
        self.saker("characterise", "fit", samples, "-o", model, "--set", "fit.range_edges_m=[3, 7, 12]", "--set",
                   "fit.sectors=4")
        self.assertRegex(model.read_text(), r"range_edges: \[3, 7, 12\]")
        self.assertRegex(model.read_text(), r"sectors: 4\b")
        self.assertEqual({length for _, length in self.length_biases(model.read_text())}, {0}, "about the truth")
        for wrong, said in [("fit.sectors=1", "sectors"), ("fit.range_edges_m=[3, 2]", "ascending"),
                            ("fit.least_objects=19", "bin: 18 objects")]:
            run = self.saker("characterise", "fit", samples, "-o", self.folder / "no.yaml", "--set", wrong, status=2)
            self.assertIn(said, run.stderr)

    def assert_known(self, model):
        text = model.read_text()
        self.assertEqual(re.findall(r"- name: (\w+)", text), ["vehicle", "trunk", "pole", "bin"])
        self.assertIn("six yards", text)
        for sector, expected in [(0, FRONT_BIAS), (2, SIDE_BIAS), (3, SIDE_BIAS), (5, FRONT_BIAS)]:
            found = [length for s, length in self.length_biases(text) if s == sector]
            self.assertTrue(found)
            for length in found:
                self.assertAlmostEqual(length, expected, delta=0.04)

    def length_biases(self, text):
        """Of the bins: sector and bias of each interval that was seen by all."""
        own = text[text.index("- name: bin"):].split("intervals:")[1]
        intervals = re.findall(r"objects: (\d+)[^\[]*?bias: \[([^\]]*)\]", own, re.S)
        return [(i % 6, float(bias.split(",")[2])) for i, (objects, bias) in enumerate(intervals)
                if int(objects) >= RECORDINGS * len(SIZES)]

    def assert_starts(self, model):
        drive = self.folder / "drive"
        drive.mkdir()
        points = [(12 * math.cos(a), 12 * math.sin(a), z / 10, 0.3) for a in (i / 50 for i in range(314))
                  for z in range(-17, 5)]
        for i in range(2):
            (drive / f"{i:06d}.bin").write_bytes(b"".join(struct.pack("<4f", *p) for p in points))
        self.saker("replay", drive, "-o", self.folder / "out", "--set", f"uncertainty.model={model}", "--set",
                   "slam.measurement_noise=fitted")

    def assert_needed_where_views_are_chosen(self, model):
        """Bins are targets: a policy that seeks views must know what a view of them tells."""
        flight = ["experiment", ROOT / "configs/scenarios/small.yaml", "--set", "active.policy=paper", "--set",
                  "mission.preflight_s=1"]
        run = self.saker(*flight, "-o", self.folder / "unknown", status=2)
        self.assertIn("does not know the target class 'bin'", run.stderr)
        # Known, it starts, and waits for more than a second for its first map.
        self.saker(*flight, "-o", self.folder / "known", "--set", f"uncertainty.model={model}", status=1)
        results = json.loads((self.folder / "known/results.json").read_text())
        self.assertEqual((results["policy"], results["outcome"]), ("paper", "preflight_deadline"))


if __name__ == "__main__":
    unittest.main()
