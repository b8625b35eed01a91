"""tools/training/pieces.py finds the weights that pieces were made by."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

TRAINING = pathlib.Path(__file__).resolve().parents[2] / "tools/training"
sys.path.insert(0, str(TRAINING))

try:
    import numpy as np
except ImportError as missing:
    print(f"skipped: {missing} (Debian's python3-numpy)")
    sys.exit(77)

import pieces

TRUE = np.array([[-0.5, 1.0], [0.3, -2.0]])  # of one and width


def made(count, pixels, seed=1):
    """Features and pixels by kind: all pixels of a piece are of one kind."""
    rng = np.random.default_rng(seed)
    features = np.column_stack([np.ones(count), rng.normal(size=count)])
    kinds = [rng.choice(3, p=p) for p in pieces.probabilities(features, TRUE)]
    return features, pixels * np.eye(3)[kinds]


def table(features, pixels):
    rows = [f"{i:06d},{','.join(map(str, f))},{','.join(str(int(n)) for n in p)}" for i, (f, p) in enumerate(zip(features, pixels))]
    return "\n".join(["scan,one,width,crowned,bare,neither", *rows]) + "\n"


class Fit(unittest.TestCase):
    def test_the_weights_that_pieces_were_made_by_are_found(self):
        features, pixels = made(20000, 3)
        self.assertLess(abs(pieces.fit(features, pixels) - TRUE).max(), 0.1)

    def test_one_kind_against_neither_is_found_too(self):
        rng = np.random.default_rng(3)
        features = np.column_stack([np.ones(20000), rng.normal(size=20000)])
        true = np.array([[0.4, -1.5]])
        is_one = rng.random(20000) < pieces.probabilities(features, true)[:, 0]
        self.assertLess(abs(pieces.fit(features, np.column_stack([is_one, ~is_one]).astype(float)) - true).max(), 0.1)

    def test_probabilities_sum_to_one_however_large_the_scores_are(self):
        p = pieces.probabilities(np.array([[1.0, 1000.0], [1.0, -1000.0]]), TRUE)
        self.assertTrue(np.allclose(p.sum(1), 1))

    def test_with_power_zero_a_piece_counts_once_and_with_one_by_its_pixels(self):
        pixels = np.array([[4.0, 0, 0], [0, 1.0, 1.0]])
        self.assertEqual(pieces.weighted(pixels, 0).sum(1).tolist(), [1, 1])
        self.assertEqual(pieces.weighted(pixels, 1).sum(1).tolist(), [4, 2])

    def test_a_piece_is_judged_by_a_fit_that_has_not_seen_its_world(self):
        features, pixels = made(400, 1)
        worlds = np.arange(400) // 4
        changed = pixels.copy()
        first = worlds % pieces.FOLDS == 0
        changed[first] = changed[first][:, ::-1]
        before, after = (pieces.held_out(features, counts, worlds, 1.0) for counts in (pixels, changed))
        self.assertTrue(np.allclose(before[first], after[first]))
        self.assertFalse(np.allclose(before[~first], after[~first]))

    def test_iou_is_that_of_the_pixels(self):
        p = np.array([[0.8, 0.1, 0.1], [0.1, 0.8, 0.1], [0.1, 0.1, 0.8]])
        trunk, pole = pieces.iou(np.array([[3.0, 1, 0], [0, 2, 0], [1, 1, 5]]), p)
        self.assertAlmostEqual(trunk, 3 / 5)
        self.assertAlmostEqual(pole, 2 / 4)


class Description(unittest.TestCase):
    def test_a_table_of_no_family_is_refused(self):
        with tempfile.TemporaryDirectory(prefix="saker_pieces_") as folder:
            rows = pathlib.Path(folder, "pieces.csv")
            rows.write_text("scan,one,cat,dog\n")
            with self.assertRaisesRegex(SystemExit, "scan,one,cat,dog: expected those of cylinders or vehicles"):
                pieces.read([rows])

    def test_it_is_written_into_the_description_once(self):
        with tempfile.TemporaryDirectory(prefix="saker_pieces_") as folder:
            model, rows = pathlib.Path(folder, "m.yaml"), pathlib.Path(folder, "pieces.csv")
            model.write_text("sha256: a\ncylinders:\n  crowned:\n    old: 1\nfit:\n  scans: 3\n")
            rows.write_text(table(*made(500, 2)))
            for _ in range(2):
                subprocess.run([sys.executable, "-B", TRAINING / "pieces.py", model, rows, "--scans", "made"], check=True, capture_output=True)
            text = model.read_text()
        self.assertTrue(text.startswith("sha256: a\nfit:\n  scans: 3\ncylinders:\n  crowned:\n    one: "))
        self.assertEqual(text.count("cylinders:"), 1)
        self.assertNotIn("old", text)
        self.assertIn("  bare:\n    one: ", text)
        self.assertIn("  scans: made\n", text)


if __name__ == "__main__":
    unittest.main()
