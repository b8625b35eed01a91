"""scripts/real: what is worse than before is told, and the program's measures are those that lie beside the recordings."""

import importlib.machinery
import importlib.util
import json
import re
import subprocess
import unittest

from program import ROOT, ProgramTest, saker

LOADER = importlib.machinery.SourceFileLoader("real", str(ROOT / "scripts/real"))
real = importlib.util.module_from_spec(importlib.util.spec_from_loader("real", LOADER))
LOADER.exec_module(real)

MEASURES = real.DATA.parent / "eval"


def script(*arguments):
    return subprocess.run([ROOT / "scripts/real", *map(str, arguments)], capture_output=True, text=True, timeout=280)


class Figures(unittest.TestCase):
    def test_a_fall_within_the_noise_is_none(self):
        self.assertFalse(real.fell(real.figure(0.80, "higher", 0.02), 0.79))
        self.assertTrue(real.fell(real.figure(0.80, "higher", 0.02), 0.77))

    def test_a_rise_is_no_fall(self):
        self.assertFalse(real.fell(real.figure(0.80, "higher", 0.02), 0.99))
        self.assertFalse(real.fell(real.figure(0.12, "lower", 0.01), 0.05))

    def test_a_bias_is_worse_on_either_side(self):
        self.assertTrue(real.fell(real.figure(0.02, "zero", 0.01), -0.04))
        self.assertFalse(real.fell(real.figure(-0.04, "zero", 0.01), 0.02))

    def test_a_consistency_is_worse_farther_from_one(self):
        self.assertTrue(real.fell(real.figure(1.1, "one", 0.2), 0.5))
        self.assertFalse(real.fell(real.figure(0.5, "one", 0.2), 1.1))

    def test_a_figure_that_is_gone_fell(self):
        self.assertTrue(real.fell(real.figure(0.80, "higher", 0.02), None))

    def test_times_are_reported_only(self):
        self.assertFalse(real.fell(real.figure(60, "reported"), 600))

    def test_a_share_of_all_has_a_noise_too(self):
        self.assertGreater(real.share_noise(13, 13), 0.05)

    def test_one_box_is_the_median_of_all_labelled_vehicles_and_errs_by_the_listed_ones(self):
        sizes = {1: [4.0, 1.6], 2: [4.4, 1.8], 3: [5.0, 1.9]}
        labels = {"listed": [1, 2], "vehicles": [{"track": track, "size": [*size, 1.5]} for track, size in sizes.items()]}
        error, listed = real.box_error(labels)
        self.assertAlmostEqual(error, (0.4 + 0.2) / 4)
        self.assertEqual(listed, 2)

    def test_the_page_is_that_of_the_figures(self):
        self.assertEqual(real.PAGE.read_text(), real.page(json.loads(real.FIGURES.read_text())))


@unittest.skipUnless((real.DATA / "unpack").exists(), f"no recordings in {real.DATA}")
class Recordings(ProgramTest):
    def test_the_small_recordings_are_measured_as_well_as_before(self):
        run = script("--check", "--quick")
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)

    def test_a_fall_is_told_and_is_status_1(self):
        document = json.loads(real.FIGURES.read_text())
        figures = document["recordings"]["kitti_object"]["figures"]
        figures["boxes.point_precision"]["value"] += 0.1
        before = self.folder / "before.json"
        before.write_text(json.dumps(document))
        run = script("kitti_object", "--check", "--against", before)
        self.assertEqual(run.returncode, 1, run.stdout + run.stderr)
        self.assertIn("boxes.point_precision", run.stdout)

    def evaluated(self, name):
        """(what `saker evaluate` says, the folder that `saker segment` left, the recording)."""
        folder = real.unpacked(name)
        for command, out in (("evaluate", "figures"), ("segment", "segmented")):
            run = saker(command, folder, "-o", self.folder / out, "--threads", 1)
            self.assertEqual(run.returncode, 0, run.stderr)
        figures = json.loads((self.folder / "figures/evaluation.json").read_text())
        return figures, self.folder / "segmented", folder

    @unittest.skipUnless((MEASURES / "boxes.py").exists(), f"no measures in {MEASURES}")
    def test_boxes_are_counted_as_the_measure_beside_the_recordings_counts_them(self):
        figures, segmented, folder = self.evaluated("kitti_object")
        said = json.loads(subprocess.run([MEASURES / "boxes.py", segmented, folder, "--json"], check=True,
                                         capture_output=True, text=True).stdout)
        self.assertAlmostEqual(figures["box_points"]["precision"], said.pop("point_precision"), delta=0.0006)
        self.assertEqual(sorted(figures["boxes"]), sorted(said))
        for kind, row in said.items():
            self.assertEqual(figures["boxes"][kind]["boxes"], row["boxes"])
            self.assertEqual(figures["boxes"][kind]["recognised"], row["seen"])

    @unittest.skipUnless((MEASURES / "segmentation.py").exists(), f"no measures in {MEASURES}")
    def test_points_are_counted_as_the_measure_beside_the_recordings_counts_them(self):
        figures, segmented, folder = self.evaluated("semantic_kitti")
        said = subprocess.run([MEASURES / "segmentation.py", segmented, folder], check=True,
                              capture_output=True, text=True).stdout
        rows = re.findall(r"(\w+) +IoU ([\d.]+)  precision ([\d.]+)  recall ([\d.]+)  \((\d+) points", said)
        self.assertEqual(len(rows), 4)
        for name, *shares, points in rows:
            row = figures["classes"][name]
            self.assertEqual(row["labelled_points"], int(points))
            for key, share in zip(("iou", "precision", "recall"), shares):
                self.assertAlmostEqual(row[key], float(share), delta=0.0006)


if __name__ == "__main__":
    unittest.main()
