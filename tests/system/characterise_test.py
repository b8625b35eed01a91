"""`saker characterise fly` and `collect` through the program."""

import csv
import json
import math
import unittest

from program import ProgramTest, saker

SPIRAL = """kind: spiral
spiral: {duration_s: 10, clutter: 4}
"""
# A car at (10, 0), heading along y, seen from (0, 0) and from (10, -12): from behind it.
HALF = math.sqrt(0.5)
TRUE_CAR = {"id": 4, "class": "vehicle", "probability": 1, "observations": 20, "position": [10, 0, 0.7],
            "rotation": [0, 0, HALF, HALF], "size": [4.5, 1.8, 1.4]}
TRUE_POLE = {"id": 7, "class": "pole", "probability": 1, "observations": 20, "root": [0, 8, 0],
             "axis": [0, 0, 1], "radius": 0.1, "height": 4}
POSES = {"100.000000": (0, 0, 2), "100.500000": (10, -12, 2)}


def row(time, model, name="vehicle", **more):
    probability = {"vehicle": [0.1, 0.8, 0, 0, 0.1], "pole": [0.2, 0, 0.1, 0.7, 0]}[name]
    return {"time": time, "class": name, "class_probability": probability, "model": model, "points": 90,
            "moving": False, "covariance": [], **more}


def cuboid(x, y, length, width):
    return {"position": [x, y, -1.3], "rotation": [0, 0, HALF, HALF], "size": [length, width, 1.4]}


DETECTIONS = [
    row(100.0, cuboid(10.2, 0.1, 4.3, 1.9), reflectivity=0.25),
    row(100.0, {"root": [0.05, 8.1, -2], "axis": [0, 0, 1], "radius": 0.1, "height": 3}, "pole"),
    row(100.0, cuboid(13, 0, 4, 2)),  # of nothing that is known
    row(100.5, cuboid(0, 12.3, 4.5, 1.8)),
]


class Collect(ProgramTest):
    def made_run(self, lines=None):
        run = self.folder / "lot"
        run.mkdir(exist_ok=True)
        text = [json.dumps(line) for line in DETECTIONS] if lines is None else lines
        (run / "detections.jsonl").write_text("".join(line + "\n" for line in text))
        (run / "trajectory.txt").write_text(
            "".join(f"{t} {x} {y} {z} 0 0 0 1\n" for t, (x, y, z) in POSES.items()))
        self.write_map(run / "map.json")
        return run

    def write_map(self, file, observations=20):
        objects = [{**TRUE_CAR, "observations": observations}, TRUE_POLE]
        file.write_text(json.dumps({"frame": "world", "objects": objects, "ground": []}))

    def collected(self, *arguments):
        out = self.folder / "samples.csv"
        run = saker("characterise", "collect", *arguments, "-o", out, "--force")
        self.assertEqual(run.returncode, 0, run.stderr)
        with out.open() as file:
            return list(csv.DictReader(file))

    def assert_numbers(self, sample, **expected):
        for name, value in expected.items():
            self.assertAlmostEqual(float(sample[name]), value, places=5, msg=name)

    def test_errors_and_views_are_those_of_the_measurements(self):
        run = self.made_run()
        truth = self.folder / "truth.json"
        self.write_map(truth)
        samples = self.collected(run, "--truth", truth)
        self.assertEqual([(s["recording"], s["object_id"], s["class"]) for s in samples],
                         [("lot", "4", "vehicle"), ("lot", "7", "pole"), ("lot", "4", "vehicle")])
        side, pole, behind = samples
        self.assert_numbers(side, range=10, angle=math.pi / 2, elevation=math.atan2(1.3, 10), reflectivity=0.25,
                            points=90, confidence=0.8, time_s=0, error_x=0.1, error_y=-0.2, error_length=-0.2,
                            error_width=0.1)
        self.assert_numbers(pole, range=8, angle=0, confidence=0.7, error_x=0.1, error_y=-0.05)
        self.assertEqual((pole["error_length"], pole["reflectivity"]), ("", "nan"))
        self.assert_numbers(behind, range=12, time_s=0.5, error_x=0.3, error_y=0, error_length=0)
        self.assertAlmostEqual(abs(float(behind["angle"])), math.pi, places=5)

    def test_a_box_that_looks_more_like_something_else_is_read_as_a_box(self):
        doubtful = {**DETECTIONS[0], "class": "other", "class_probability": [0.5, 0.4, 0, 0, 0.1]}
        run = self.made_run([json.dumps(line) for line in [doubtful, *DETECTIONS[1:]]])
        self.assertEqual([s["class"] for s in self.collected(run)][-2:], ["pole", "vehicle"])

    def test_sizes_by_hand_stand_beside_places_from_the_map(self):
        run = self.made_run()
        table = self.folder / "dimensions.yaml"
        table.write_text("objects:\n  - {recording: lot, id: 4, kind: estate, length_m: 4.4, width_m: 1.7}\n")
        car, pole, _ = self.collected(run, "--dimensions", table)
        self.assertEqual((car["kind"], pole["kind"]), ("estate", ""))
        self.assert_numbers(car, error_x=0.1, error_length=-0.1, error_width=0.2)

    def test_of_a_map_alone_only_objects_that_were_seen_often_are_true(self):
        run = self.made_run()
        self.assertEqual(len(self.collected(run)), 3)
        self.write_map(run / "map.json", observations=3)
        self.assertEqual([s["class"] for s in self.collected(run)], ["pole"])

    def test_bad_input_is_one_line_and_status_2(self):
        refused = lambda *arguments: self.refused("characterise", "collect", *arguments, "-o",
                                                  self.folder / "no.csv")
        self.assertIn("nowhere", refused(self.folder / "nowhere"))
        run = self.made_run()
        table = self.folder / "dimensions.yaml"
        table.write_text("objects:\n  - {recording: lot, id: 4, length: 4.4}\n")
        self.assertIn("length", refused(run, "--dimensions", table))
        for line, said in [("{", "detections.jsonl:1"), (json.dumps(row(100.0, {})), "rotation"),
                           (json.dumps(row(100.0, cuboid(1, 2, -3, 1))), "-3"),
                           (json.dumps(row(777.0, cuboid(1, 2, 3, 1))), "777"),
                           (json.dumps(row(100.0, cuboid(70, 2, 3, 1))), "no measurement")]:
            with self.subTest(line=line):
                self.assertIn(said, refused(self.made_run([line])))


class Fly(ProgramTest):
    def fly(self, out, *more):
        scenario = self.folder / "spiral.yaml"
        scenario.write_text(SPIRAL)
        run = saker("characterise", "fly", "-o", out, "--scenario", scenario, "--classes", "vehicle", *more)
        self.assertEqual(run.returncode, 0, run.stderr)

    def test_a_resumed_run_gives_the_same_bytes_and_flies_only_what_is_missing(self):
        out = self.folder / "out"
        self.fly(out, "--objects", 2)
        files = [out / "samples.csv", out / "coverage.csv"]
        once = [file.read_bytes() for file in files]
        kept = (out / "flights/00000.csv").stat().st_mtime_ns
        (out / "flights/00001.csv").unlink()
        for file in files:
            file.unlink()
        self.fly(out, "--objects", 2, "--threads", 2)
        self.assertEqual([file.read_bytes() for file in files], once)
        self.assertEqual((out / "flights/00000.csv").stat().st_mtime_ns, kept)

        with files[0].open() as file:
            samples = list(csv.DictReader(file))
        self.assertGreater(len(samples), 10)
        errors = sorted(math.hypot(float(s["error_x"]), float(s["error_y"])) for s in samples)
        self.assertLess(errors[len(errors) // 2], 0.5)
        # What was flown with one seed is not mixed with another's.
        self.assertIn("holds", self.refused("characterise", "fly", "-o", out, "--seed", 2))


    def test_flies_without_a_fitted_model_whatever_is_configured(self):
        """A model fitted to what a model had corrected would feed on itself."""
        once, again = self.folder / "once", self.folder / "again"
        self.fly(once, "--objects", 1)
        self.fly(again, "--objects", 1, "--set", "slam.measurement_noise=fitted", "--set",
                 f"uncertainty.model={self.folder / 'none.yaml'}")
        self.assertEqual((once / "samples.csv").read_bytes(), (again / "samples.csv").read_bytes())


class FlyRefuses(ProgramTest):
    def test_a_scenario_of_another_kind_and_a_class_that_cannot_be_made(self):
        scenario = self.folder / "mission.yaml"
        scenario.write_text("kind: mission\n")
        out = self.folder / "out"
        self.assertIn("spiral", self.refused("characterise", "fly", "-o", out, "--scenario", scenario))
        self.assertIn("bin", self.refused("characterise", "fly", "-o", out, "--classes", "bin"))


if __name__ == "__main__":
    unittest.main()
