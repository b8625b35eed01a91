"""scripts/noise-fit finds the values that errors were made with."""

import json
import math
import os
import pathlib
import random
import subprocess
import sys
import tempfile
import unittest

import repository

sys.path.insert(0, str(repository.ROOT / "scripts"))
from evidence import map_errors, variances  # noqa: E402

FLOWN = {"shared_radius_cells": 10.0, "common_radius_m": 0.015, "common_taper": 0.12, "common_root": 0.13}
TRUE = {"shared_radius_cells": 4.0, "common_radius_m": 0.03, "common_taper": 0.3, "common_root": 0.4}
CONFIGURATION = """# Saker's configuration.
slam:
  measurement_noise: fitted  # what
  noise:  # what is added
    shared_radius_cells: 10  # cells
    common_radius_m: 0.015  # m
    common_taper: 0.12
    common_root: 0.13
    share_ends: true
  graph:
    noise: 3
detection:
  noise:
    common_root: 7
"""


def sd_of_radius(values, graph, radius):
    return math.sqrt(values["shared_radius_cells"] * graph ** 2 + values["common_radius_m"] ** 2 + (values["common_taper"] * radius) ** 2)


def sd_of_root(values, graph, radius):
    return math.hypot(graph, values["common_root"] * radius)


def poles(draw, count):
    """Mapped and true: they differ as TRUE says, and the map states what FLOWN says."""
    mapped, truth = [], []
    for i in range(count):
        radius, graph = draw.choice((0.05, 0.15, 0.4)), draw.choice((0.002, 0.01, 0.03))
        off = [draw.gauss(0, sd_of_root(TRUE, graph, radius)) for _ in range(2)]
        sd = {"root": [sd_of_root(FLOWN, graph, radius)] * 2 + [1], "radius": sd_of_radius(FLOWN, graph, radius)}
        mapped.append({"class": "pole", "root": [10 * i + off[0], off[1], 0], "radius": radius, "sd": sd})
        true_radius = radius + draw.gauss(0, sd_of_radius(TRUE, graph, radius))
        truth.append({"class": "pole", "root": [10 * i, 0, 0], "radius": true_radius})
    return mapped, truth


class Runs(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory(prefix="saker_noise_")
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)

    def leave(self, runs, configuration=CONFIGURATION):
        (self.folder / "experiment.json").write_text(json.dumps({"configuration": configuration}))
        for name, (mapped, truth) in runs.items():
            (self.folder / name).mkdir()
            (self.folder / name / "map.json").write_text(json.dumps({"objects": mapped}))
            (self.folder / name / "truth.json").write_text(json.dumps({"objects": truth}))

    def fit(self, *words):
        return subprocess.run([repository.ROOT / "scripts/noise-fit", self.folder, *words], capture_output=True, text=True)

    def test_the_values_that_errors_were_made_with_are_found(self):
        draw = random.Random(3)
        self.leave({f"seed-{i}": poles(draw, 25) for i in range(12)})
        run = self.fit("-o", str(self.folder / "noise.yaml"), "--commit", "1a2b3c4")
        self.assertEqual(run.returncode, 0, run.stderr)
        text = (self.folder / "noise.yaml").read_text()
        found = {line.split(":")[0].strip(): float(line.split(":")[1]) for line in text.splitlines() if line.startswith("    ")}
        self.assertEqual(found.keys(), TRUE.keys())
        self.assertAlmostEqual(found["common_root"] / TRUE["common_root"], 1, delta=0.15)
        self.assertAlmostEqual(found["common_taper"] / TRUE["common_taper"], 1, delta=0.3)
        self.assertIn("12 runs; flown by 1a2b3c4", text)
        honest = [float(row.split("|")[3]) for row in run.stdout.splitlines() if row.startswith(("| radius", "| root"))]
        self.assertEqual(len(honest), 2)
        for value in honest:
            self.assertAlmostEqual(value, 1, delta=0.02)

    def test_what_it_writes_is_a_configuration(self):
        self.leave({"seed-1": poles(random.Random(1), 40)})
        self.fit("-o", str(self.folder / "noise.yaml"))
        run = subprocess.run([os.environ["SAKER"], "config", "--config", self.folder / "noise.yaml"], capture_output=True, text=True)
        self.assertEqual(run.returncode, 0, run.stderr)

    def test_few_errors_fit_nothing(self):
        self.leave({"seed-1": poles(random.Random(1), 5)})
        run = self.fit("-o", str(self.folder / "noise.yaml"))
        self.assertEqual(run.returncode, 1)
        self.assertFalse((self.folder / "noise.yaml").exists())
        self.assertIn("radius: 5 errors, expected 20", run.stderr)

    def test_runs_of_different_noise_and_none_are_refused_in_a_line(self):
        run = self.fit()
        self.assertIn("no map.json", run.stderr)
        self.assertEqual(run.returncode, 2)
        self.leave({"seed-1": poles(random.Random(1), 5)}, "slam:\n  graph: 3\n")
        run = self.fit()
        self.assertEqual((run.returncode, len(run.stderr.splitlines())), (2, 1), run.stderr)
        self.assertIn("without slam.noise", run.stderr)


class Errors(unittest.TestCase):
    def car(self, x=0.0, y=0.0, turn=0.0, length=4.5):
        return {"class": "vehicle", "position": [x, y, 0], "rotation": [0, 0, math.sin(turn / 2), math.cos(turn / 2)], "size": [length, 1.8, 1.5],
                "sd": {"position": [0.1, 0.2, 0.3], "size": [0.4, 0.5, 0.6]}}

    def kind(self, name):
        return next(kind for kind in map_errors.kinds(map_errors.FIXED) if kind.name == name)

    def test_a_place_is_in_the_objects_own_frame(self):
        found = map_errors.of_pair(self.car(1, 0, math.pi / 2), self.car(0, 0, math.pi / 2), self.kind("place"))
        self.assertAlmostEqual(found[0][0], 0)
        self.assertAlmostEqual(found[1][0], -1)

    def test_a_vehicle_back_to_front_has_its_length_and_one_across_has_none(self):
        length = self.kind("length")
        self.assertAlmostEqual(map_errors.of_pair(self.car(length=4.7), self.car(turn=math.pi), length)[0][0], 0.2)
        self.assertEqual(map_errors.of_pair(self.car(), self.car(turn=math.pi / 2), length), [])

    def test_pairs_are_each_others_nearest_of_one_class_within_the_gate(self):
        bus = {**self.car(), "class": "bus"}
        pairs = list(map_errors.pairs([self.car(0.2), self.car(0.6), self.car(9)], [self.car(), bus, self.car(11)], "cuboid"))
        self.assertEqual([(one["position"][0], other["position"][0]) for one, other in pairs], [(0.2, 0)])

    def test_values_are_those_of_slam_noise_alone(self):
        values, source = map_errors.values_of(CONFIGURATION)
        self.assertEqual((values, source), ({**FLOWN, "share_ends": 1.0}, "fitted"))


class Variances(unittest.TestCase):
    def test_one_weight_is_the_mean_square(self):
        rows = [(error, [1.0], 0.0) for error in (1.0, -2.0, 3.0)]
        self.assertAlmostEqual(variances.fit(rows, [1.0])[0], 14 / 3, places=2)
        self.assertAlmostEqual(variances.nees(rows, [14 / 3]), 1)

    def test_what_is_known_is_not_fitted_again(self):
        self.assertLess(variances.fit([(0.5, [1.0], 1.0), (-0.5, [1.0], 1.0)], [1.0])[0], 1e-6)
        self.assertAlmostEqual(variances.fit([(2.0, [1.0], 1.0), (-2.0, [1.0], 1.0)], [1.0])[0], 3, places=3)


if __name__ == "__main__":
    unittest.main()
