"""Labelled scans (SemanticKITTI layout: DIR/velodyne/*.bin, DIR/labels/*.label and, where the recording has them, ring numbers
DIR/ring/*.u8 or *.u16; also inside folders of DIR) as samples for the network."""
import csv
import multiprocessing
import pathlib

import numpy as np
import torch

import augmentation
import inputs
import labels as classes

ROWS, COLUMNS = 80, 1024  # of the images that are kept: what modules/segmentation/range_image.h gives at most
LEAST_ROWS = 8  # fewer hold nothing to learn from: a sensor that is hidden
MIXED = 0.5  # share of the scans that get parts of another one
STEP = 16  # rows of a batch are a multiple of this
RARE = [classes.OUTPUTS.index(name) for name in ("trunk", "pole", "van", "truck", "bus", "other_vehicle")]


def files(folder):
    """(scan, labels) of every scan below a folder, in the order of the names."""
    scans = sorted(p for p in pathlib.Path(folder).rglob("*.bin") if p.parent.name == "velodyne")
    return [(p, p.parent.parent / "labels" / (p.stem + ".label")) for p in scans]


def held_out(folder, most=40):
    """The last twentieth of the scans, at most so many: never trained on."""
    every = files(folder)
    return every[trained(len(every)):][:most]


def trained(count):
    """How many of the first of so many scans are trained on."""
    return count - max(1, count // 20)


def read_scan(scan, truth):
    """Points (n, 3) and what the network should call them."""
    points = np.fromfile(scan, np.float32).reshape(-1, 4)[:, :3]
    return points, classes.table()[np.fromfile(truth, np.uint32) & 0xFFFF]


def read_rings(scan):
    """Ring number of each point, or None."""
    folder = scan.parent.parent / "ring"
    for suffix, kind in ((".u8", np.uint8), (".u16", np.uint16)):
        file = folder / (scan.stem + suffix)
        if file.exists():
            return np.fromfile(file, kind)
    return None


def image_of(points, label, ring=None):
    """Image of points, image of classes (IGNORED where nothing returned), pixel of each point."""
    index, pixel = inputs.project(points, ring)
    image = np.full(index.shape + (3,), np.nan, np.float32)
    image[index >= 0] = points[index[index >= 0]]
    truth = np.where(index >= 0, label[np.maximum(index, 0)], classes.IGNORED).astype(np.uint8)
    return image, truth, pixel


def project_into(job):
    """Projects scan i into the files of a folder. \return its rows and columns"""
    folder, shape, i, scan, truth = job
    image, label, _ = image_of(*read_scan(scan, truth), read_rings(scan) if i % 2 else None)
    rows, columns = label.shape
    np.memmap(folder / "images.f32", np.float32, "r+", shape=shape + (3,))[i, :rows, :columns] = image
    np.memmap(folder / "images.u8", np.uint8, "r+", shape=shape)[i, :rows, :columns] = label
    return rows, columns


class Images:
    """The projected scans of a folder, kept in files beside them so that every pass reads pixels only.

    Every second scan is projected without its ring numbers: most recordings have none.
    """

    def __init__(self, folder):
        folder = pathlib.Path(folder)
        self.names = [str(scan.relative_to(folder)) for scan, _ in files(folder)]
        shape = (len(self.names), ROWS, COLUMNS)
        if not (folder / "images.done").exists():
            self._project(folder, shape)
        self.points = np.memmap(folder / "images.f32", np.float32, "r", shape=shape + (3,))
        self.truths = np.memmap(folder / "images.u8", np.uint8, "r", shape=shape)
        self.sizes = np.load(folder / "images.npy")
        self.sensors = self._sensors(folder)

    def _sensors(self, folder):
        """(sensor and frame, height) of every scan; None where the folder does not tell."""
        table = folder / "sensors.csv"
        if not table.exists():
            return None
        with table.open() as file:
            rows = {row["name"]: row for row in csv.DictReader(file)}
        of = [rows[pathlib.Path(name).stem] for name in self.names]
        return [(row["sensor"] + row["frame"], float(row["height_m"])) for row in of]

    def partners(self, i, chosen):
        """Those of the chosen scans that the same sensor took at about the same height."""
        if self.sensors is None:
            return np.array([], int)
        sensor, height = self.sensors[i]
        return np.array([k for k in chosen if k != i and self.sensors[k][0] == sensor and (self.sizes[k] == self.sizes[i]).all()
                         and abs(self.sensors[k][1] - height) < max(0.25, 0.08 * height)], int)

    @staticmethod
    def _project(folder, shape):
        for name, kind, more in (("images.f32", np.float32, (3,)), ("images.u8", np.uint8, ())):
            np.memmap(folder / name, kind, "w+", shape=shape + more)
        jobs = [(folder, shape, i, scan, truth) for i, (scan, truth) in enumerate(files(folder))]
        with multiprocessing.Pool() as pool:
            np.save(folder / "images.npy", np.array(pool.map(project_into, jobs, 16), np.int32))
        (folder / "images.done").touch()

    def __len__(self):
        return len(self.names)

    def __getitem__(self, i):
        """Points and truth of one scan."""
        rows, columns = self.sizes[i]
        return np.array(self.points[i, :rows, :columns]), np.array(self.truths[i, :rows, :columns])


class Batches(torch.utils.data.Dataset):
    """Item i is a whole batch: crops of augmented scans that have about as many rows."""

    def __init__(self, images, chosen, batch, width, seed):
        self.images, self.batch, self.width, self.seed = images, batch, width, seed
        odds = np.array([self._odds(i) for i in chosen])
        self.partners = {i: images.partners(i, chosen) for i in chosen}
        filled = -(-images.sizes[chosen, 0] // STEP)
        self.alike = [(STEP * k, np.array(chosen)[filled == k], odds[filled == k]) for k in np.unique(filled)]
        self.share = np.array([share.sum() for _, _, share in self.alike]) / odds.sum()

    def _odds(self, i):
        """Scans with rare classes come more often."""
        rows, columns = self.images.sizes[i]
        return 1 + min(np.isin(self.images.truths[i, :rows, :columns], RARE).sum(), 3000) / 1000

    def __len__(self):
        return 1 << 30

    def __getitem__(self, number):
        rng = np.random.default_rng((self.seed, number))
        rows, scans, odds = self.alike[rng.choice(len(self.alike), p=self.share)]
        beams = 2 if rows > STEP and rng.random() < 0.15 else 1
        rows = -(-rows // beams // STEP) * STEP
        samples, wanted = [], max(1, self.batch * 64 // rows)
        while len(samples) < wanted:
            scan = rng.choice(scans, p=odds / odds.sum())
            points, label = self.images[scan]
            if len(self.partners[scan]) and rng.random() < MIXED:
                points, label = augmentation.mix(points, label, *self.images[rng.choice(self.partners[scan])], rng)
            if beams > 1:
                points, label = augmentation.fewer_beams(points, label, beams, rng)
            samples += self._crops(points, label, rows, rng)
        values, truth = zip(*samples[:wanted])
        return torch.from_numpy(np.stack(values)), torch.from_numpy(np.stack(truth).astype(np.int64))

    def _crops(self, points, label, rows, rng):
        """Two of one augmented scan, at random places."""
        points, label = augmentation.augment(points, label, rng)
        values = inputs.features(points)
        if len(points) < rows:
            values = np.pad(values, ((0, 0), (0, rows - len(points)), (0, 0)))
            label = np.pad(label, ((0, rows - len(label)), (0, 0)), constant_values=classes.IGNORED)
        places = points.shape[1] // self.width
        return [(values[:, :, c:c + self.width], label[:, c:c + self.width])
                for c in rng.permutation(places)[:2] * self.width]
