"""scripts/clutter-fit judges objects by their windows as the map does, and chooses on other drives than it reports."""

import importlib.machinery
import importlib.util
import json
import pathlib
import sys
import tempfile
import unittest

import repository

sys.dont_write_bytecode = True


def script():
    loader = importlib.machinery.SourceFileLoader("clutter_fit", str(repository.ROOT / "scripts/clutter-fit"))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader(loader.name, loader))
    loader.exec_module(module)
    return module


FIT = script()
STEPS = 20  # windows of each object, 0.5 s apart


class Drive(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory(prefix="saker_clutter_")
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)

    def drive(self, *objects):
        """Of a sensor that stands still; objects: (track or None where nothing is labelled, x, probability, points)."""
        vehicles = [{"track": track, "parked": True, "labels": [[i, x, 0, 0, 4.5, 1.8, 0] for i in range(STEPS)]}
                    for track, x, *_ in objects if track is not None]
        said = {"listed": [vehicle["track"] for vehicle in vehicles], "vehicles": vehicles}
        (self.folder / "vehicles.json").write_text(json.dumps(said))
        (self.folder / "times.txt").write_text("".join(f"{0.5 * i}\n" for i in range(STEPS)))
        (self.folder / "trajectory.txt").write_text("".join(f"{0.5 * i} 0 0 0 0 0 0 1\n" for i in range(STEPS)))
        rows = [json.dumps({"time": 0.5 * i, "class_probability": [1 - p, p], "points": points, "model": {"position": [x, 0, 0], "size": [4, 2, 1.5]}})
                for i in range(STEPS) for _, x, p, points in objects]
        (self.folder / "detections.jsonl").write_text("\n".join(rows) + "\n")
        return FIT.Objects(self.folder, self.folder)

    def test_windows_belong_to_the_labelled_vehicle_or_make_a_false_object(self):
        objects = self.drive((7, 10, 0.9, 500), (None, 20, 0.9, 500))
        self.assertEqual([len(rows) for rows in objects.vehicles.values()], [STEPS])
        self.assertEqual([len(rows) for rows in objects.false], [STEPS])
        self.assertEqual(objects.judged(0), (1, 1))

    def test_few_points_say_less_the_more_points_the_prior_is_worth(self):
        objects = self.drive((7, 10, 0.9, 2000), (None, 20, 0.9, 5))
        self.assertEqual(objects.judged(0), (1, 1))
        self.assertEqual(objects.judged(1000), (1, 0))

    def test_the_middle_value_is_chosen_of_those_that_tell_vehicles_from_the_rest(self):
        objects = self.drive((7, 10, 0.9, 100), (None, 20, 0.9, 5))
        worth = {points: objects.judged(points) for points in FIT.POINTS}
        best = [points for points, row in worth.items() if row == (1, 0)]
        self.assertIn(FIT.chosen([objects]), best, worth)
        self.assertEqual(sum(points < FIT.chosen([objects]) for points in best), len(best) // 2)

    def test_doubted_windows_and_few_of_them_make_no_object(self):
        self.assertEqual(self.drive((7, 10, FIT.NEUTRAL, 500)).judged(0), (0, 0))
        self.assertFalse(FIT.believed([(0.1 * i, 0.99, 500) for i in range(int(FIT.WINDOWS) - 1)], 0))


if __name__ == "__main__":
    unittest.main()
