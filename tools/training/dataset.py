"""Labelled scans (SemanticKITTI layout: DIR/velodyne/*.bin and DIR/labels/*.label, also inside folders of DIR) as samples for the
network."""
import pathlib

import numpy as np
import torch

import augmentation
import inputs
import labels as classes

ROWS = 64  # of the images that are kept; rings that unfolding finds beyond them are dropped
COLUMNS = 1024


def files(folder):
    """(scan, labels) of every scan below a folder, in the order of the names."""
    scans = sorted(p for p in pathlib.Path(folder).rglob("*.bin") if p.parent.name == "velodyne")
    return [(p, p.parent.parent / "labels" / (p.stem + ".label")) for p in scans]


def read_scan(scan, truth):
    """Points (n, 3) and their classes."""
    points = np.fromfile(scan, np.float32).reshape(-1, 4)[:, :3]
    return points, classes.table()[np.fromfile(truth, np.uint32) & 0xFFFF]


def image_of(points, label):
    """Image of points, image of classes (IGNORED where nothing returned), pixel of each point."""
    index, pixel = inputs.project(points)
    image = np.full(index.shape + (3,), np.nan, np.float32)
    image[index >= 0] = points[index[index >= 0]]
    truth = np.where(index >= 0, label[np.maximum(index, 0)], classes.IGNORED).astype(np.uint8)
    return image, truth, pixel


def fitted(image, truth, rows, columns):
    """Cut or padded with nothing at the bottom and on the right."""
    points = np.full((rows, columns, 3), np.nan, np.float32)
    label = np.full((rows, columns), classes.IGNORED, np.uint8)
    r, c = min(rows, len(image)), min(columns, image.shape[1])
    points[:r, :c], label[:r, :c] = image[:r, :c], truth[:r, :c]
    return points, label


class Images:
    """The projected scans of a folder, kept in a file beside them so that every pass reads pixels only."""

    def __init__(self, folder):
        self.names = [str(scan.relative_to(folder)) for scan, _ in files(folder)]
        cache = pathlib.Path(folder)
        points, truths = cache / "images.f32", cache / "images.u8"
        shape = (len(self.names), ROWS, COLUMNS)
        if not points.exists() or points.stat().st_size != 12 * np.prod(shape):
            self._project(folder, points, truths, shape)
        self.points = np.memmap(points, np.float32, "r", shape=shape + (3,))
        self.truths = np.memmap(truths, np.uint8, "r", shape=shape)

    @staticmethod
    def _project(folder, points, truths, shape):
        out = np.memmap(points, np.float32, "w+", shape=shape + (3,))
        label = np.memmap(truths, np.uint8, "w+", shape=shape)
        for i, (scan, truth) in enumerate(files(folder)):
            image, classes_, _ = image_of(*read_scan(scan, truth))
            out[i], label[i] = fitted(image, classes_, ROWS, COLUMNS)
        out.flush()
        label.flush()

    def __len__(self):
        return len(self.names)


class Batches(torch.utils.data.Dataset):
    """Item i is a whole batch: crops of augmented scans, all of one sensor (64 rows; sometimes 32 or 16, or half the columns)."""

    def __init__(self, images, chosen, batch, width, seed):
        self.images, self.chosen, self.batch, self.width, self.seed = images, chosen, batch, width, seed
        truths = images.truths
        rare = np.array([np.isin(truths[i], (2, 3)).sum() for i in chosen], float)
        self.odds = (1 + np.minimum(rare, 1500) / 500) / (1 + np.minimum(rare, 1500) / 500).sum()

    def __len__(self):
        return 1 << 30

    def __getitem__(self, number):
        rng = np.random.default_rng((self.seed, number))
        beams = rng.choice([1, 2, 4], p=[0.75, 0.18, 0.07])
        half = beams == 1 and rng.random() < 0.12
        samples = []
        while len(samples) < self.batch:
            samples += self._crops(rng, beams, half, min(2, self.batch - len(samples)))
        values, truth = zip(*samples)
        return torch.from_numpy(np.stack(values)), torch.from_numpy(np.stack(truth).astype(np.int64))

    def _crops(self, rng, beams, half, count):
        """Of one augmented scan, at random places."""
        i = rng.choice(self.chosen, p=self.odds)
        points, label = np.array(self.images.points[i]), np.array(self.images.truths[i])
        if beams > 1:
            points, label = augmentation.fewer_beams(points, label, beams, rng)
        if half:
            points, label = augmentation.fewer_columns(points, label, rng)
        points, label = augmentation.augment(points, label, rng)
        values = inputs.features(points)
        width = self.width // 2 if half else self.width
        for c in rng.permutation(points.shape[1] // width)[:count] * width:
            yield values[:, :, c:c + width], label[:, c:c + width]
