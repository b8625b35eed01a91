"""The training's own code (tools/training): run with the library of inputs in SAKER_TRAINING_INPUTS."""
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "tools/training"))

try:
    import numpy as np
    import torch
except ImportError as missing:
    print(f"skipped: {missing} (Debian's python3-torch)")
    sys.exit(77)

import augmentation
import dataset
import evaluation
import inputs
import labels as classes
import model as network
import train


GROUND, CAR = classes.OUTPUTS.index("ground"), classes.OUTPUTS.index("car")


def made_scan(rows=64, columns=1024):
    """Image of points: flat ground 2 m below the sensor, a round wall at 10 m."""
    elevation = np.radians(np.linspace(10, -25, rows))[:, None]
    azimuth = np.pi - 2 * np.pi * (np.arange(columns) + 0.5)[None] / columns
    ray = np.stack([np.cos(elevation) * np.cos(azimuth), np.cos(elevation) * np.sin(azimuth), np.sin(elevation) + 0 * azimuth], -1)
    ground = np.where(ray[..., 2] < 0, -2 / np.minimum(ray[..., 2], -1e-6), np.inf)
    wall = 10 / np.cos(elevation) + 0 * azimuth
    points = (ray * np.minimum(ground, wall)[..., None]).astype(np.float32)
    return points, np.where(ground < wall, GROUND, 0).astype(np.uint8)


class Training(unittest.TestCase):
    def test_projection_of_a_file_gives_the_image_back(self):
        points, label = made_scan()
        ring_by_ring = np.concatenate([np.roll(points[:, ::-1], -512, 1)[row] for row in range(64)])
        index, pixel = inputs.project(ring_by_ring)
        self.assertEqual(index.shape, (64, 1024))
        np.testing.assert_array_equal(ring_by_ring[index], points)
        self.assertTrue((pixel >= 0).all())

    def test_augmentation_keeps_points_and_labels_together(self):
        """Ground that is tilted, mirrored and stretched is still the plane below."""
        points, label = made_scan()
        rng = np.random.default_rng(3)
        for _ in range(10):
            changed, changed_label = augmentation.augment(points, label, rng)
            self.assertEqual(changed.shape[:2], changed_label.shape)
            height = inputs.features(changed)[3] * 0.3
            seen = np.isfinite(changed[..., 0])
            ground = height[seen & (changed_label == GROUND)]
            self.assertLess(np.median(np.abs(ground)), 0.1)

    def test_what_is_mixed_in_stands_where_its_column_looks(self):
        """A nearer car of another scan takes the place of the wall behind it and casts no other change."""
        points, label = made_scan()
        others, other_labels = points * 0.8, np.full_like(label, CAR)
        for seed in range(6):  # some sectors, some things
            changed, changed_label = augmentation.mix(points, label, others, other_labels, np.random.default_rng(seed))
            taken = changed_label == CAR
            self.assertTrue(taken.any())
            np.testing.assert_array_equal(changed[~taken], points[~taken])
            np.testing.assert_allclose(changed[taken], 0.8 * points[taken], atol=1e-3)

    def test_network_without_normalisation_gives_the_same(self):
        torch.manual_seed(1)
        model = network.RangeNet(inputs.CHANNELS, 5, (6, 8, 8, 12, 12))
        values = torch.randn(2, inputs.CHANNELS, 16, 64)
        model.train()(values)
        model.eval()
        torch.testing.assert_close(network.folded(model)(values), model(values), rtol=1e-4, atol=1e-4)

    def test_scores_of_a_column_are_where_the_head_put_them(self):
        output = torch.arange(2 * 10 * 3 * 4).float().view(2, 10, 3, 4)
        scores = network.scores(output)
        self.assertEqual(tuple(scores.shape), (2, 5, 3, 8))
        self.assertEqual(scores[1, 2, 1, 5], output[1, 5 + 2, 1, 2])

    def test_outputs_of_one_class_add_up(self):
        scores = torch.zeros(len(classes.OUTPUTS), 1, 1)
        probability = evaluation.class_probability(scores)[:, 0, 0]
        share = [(classes.CLASS_OF == k).mean() for k in range(len(classes.CLASSES))]
        np.testing.assert_allclose(probability, share, atol=1e-6)
        both = train.class_scores(scores[None]).softmax(1)[0, :, 0, 0]
        np.testing.assert_allclose(both, share, atol=1e-6)

    def test_ring_numbers_are_the_rows(self):
        points, _ = made_scan(16)
        ring = np.repeat(np.arange(16), 1024)
        shuffled = np.random.default_rng(1).permutation(len(ring))
        index, pixel = inputs.project(points.reshape(-1, 3)[shuffled], ring[shuffled])
        self.assertEqual(index.shape, (16, 1024))
        np.testing.assert_array_equal(pixel // 1024, ring[shuffled])

    def test_loss_falls_on_one_scan(self):
        points, label = made_scan()
        values = torch.from_numpy(inputs.features(points))[None, :, :, :256]
        truth = torch.from_numpy(label.astype(np.int64))[None, :, :256]
        torch.manual_seed(1)
        model = network.RangeNet(inputs.CHANNELS, len(classes.OUTPUTS), (8, 8, 8, 8, 8))
        optimizer = torch.optim.AdamW(model.parameters(), lr=1e-2)
        losses = []
        for _ in range(20):
            loss = train.loss_of(model(values), values, truth)
            optimizer.zero_grad()
            loss.backward()
            optimizer.step()
            losses.append(loss.item())
        self.assertLess(losses[-1], 0.7 * losses[0])

    def test_a_pixel_counts_by_its_range_and_not_without_a_label(self):
        values, truth = torch.zeros(1, inputs.CHANNELS, 1, 4), torch.tensor([[[0, 0, 0, classes.IGNORED]]])
        values[0, inputs.LOG_RANGE, 0] = torch.tensor([1.0, 10.0, 20.0, 20.0]).div(10).log()
        weight = train.weights_of(values, truth)[0, 0]
        torch.testing.assert_close(weight / weight[1], torch.tensor([0.5, 1.0, 2.0, 0.0]))
        self.assertAlmostEqual(weight.mean().item(), 1, places=5)

    def test_the_loss_is_the_mean_by_those_weights(self):
        torch.manual_seed(2)
        scores, truth = torch.randn(1, 3, 1, 2), torch.tensor([[[0, 2]]])
        of_class, weight = torch.tensor([1.0, 1.0, 4.0]), torch.tensor([[[1.0, 3.0]]])
        each = [train.entropy_of(scores[..., i:i + 1], truth[..., i:i + 1], torch.ones(1, 1, 1), of_class).item() for i in (0, 1)]
        both = train.entropy_of(scores, truth, weight, of_class).item()
        self.assertAlmostEqual(both, (1 * each[0] + 3 * 4 * each[1]) / (1 + 3 * 4), places=5)

    def test_batches_are_the_same_for_the_same_seed(self):
        points, label = made_scan()
        with tempfile.TemporaryDirectory() as folder:
            for name, values in (("velodyne/0.bin", np.dstack([points, label]).astype(np.float32)),
                                 ("labels/0.label", np.where(label == GROUND, 40, 50).astype(np.uint32))):
                path = pathlib.Path(folder) / name
                path.parent.mkdir(exist_ok=True)
                np.roll(values[:, ::-1], -512, 1).tofile(path)
            images = dataset.Images(folder)
            one, other = (dataset.Batches(images, [0], 2, 512, 7)[5] for _ in range(2))
        self.assertTrue(torch.equal(one[0], other[0]))
        self.assertTrue(torch.equal(one[1], other[1]))


if __name__ == "__main__":
    torch.set_num_threads(1)
    unittest.main()
