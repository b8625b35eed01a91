"""Changes to an image of points that a network must not care about, so that what it learns in simulation carries over to sensors and
places it has never seen. All take and return (points (rows, columns, 3), labels (rows, columns)); NaN where nothing returned.
"""
import numpy as np

import labels as classes

LOG_NOISE = (np.log(0.002), np.log(0.03))  # m
LOG_WAVE = (np.log(0.4), np.log(5))  # m
GROUND = classes.OUTPUTS.index("ground")
THINGS = [classes.OUTPUTS.index(name) for name in ("car", "van", "truck", "bus", "other_vehicle", "person", "two_wheeler", "pole")]


def rotation(roll, pitch, yaw):
    cr, sr, cp, sp, cy, sy = np.cos(roll), np.sin(roll), np.cos(pitch), np.sin(pitch), np.cos(yaw), np.sin(yaw)
    return np.array([[cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
                     [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
                     [-sp, cp * sr, cp * cr]], np.float32)


def fewer_beams(points, labels, factor, rng):
    """Every second or fourth row: a sensor of 32 or 16 beams."""
    first = rng.integers(factor)
    return points[first::factor], labels[first::factor]


def roll(points, labels, rng):
    by = rng.integers(points.shape[1])
    return np.roll(points, by, 1), np.roll(labels, by, 1)


def mirror(points, labels):
    return points[:, ::-1] * np.float32([1, -1, 1]), labels[:, ::-1]


def turned(points, labels, by):
    """What the sensor would have seen turned by so many columns (azimuth falls from column to column, range_image.h)."""
    yaw = -2 * np.pi * by / points.shape[1]
    return np.roll(points, by, 1) @ rotation(0, 0, yaw).T, np.roll(labels, by, 1)


def mix(points, labels, others, other_labels, rng):
    """Things and sectors of another scan of the same sensor at the same height, so that a vehicle is known by its own shape wherever
    it stands: scene and instance swapping of PolarMix (Xiao et al., NeurIPS 2022, sections 3.2 and 3.3), in the range image."""
    others, other_labels = turned(others, other_labels, rng.integers(points.shape[1]))
    points, labels = points.copy(), labels.copy()
    taken = np.isin(other_labels, THINGS)
    if rng.random() < 0.4:
        first, width = rng.integers(points.shape[1]), rng.integers(points.shape[1] // 8, points.shape[1] // 2)
        taken = ((np.arange(points.shape[1]) - first) % points.shape[1] < width)[None, :] | np.zeros_like(taken)
    else:
        nearer = np.linalg.norm(others, axis=-1) < np.nan_to_num(np.linalg.norm(points, axis=-1), nan=np.inf)
        taken &= nearer
    points[taken], labels[taken] = others[taken], other_labels[taken]
    return points, labels


def tilt(points, labels, rng, most=0.17):
    """The sensor banks; the network must find up by itself."""
    return points @ rotation(*rng.uniform(-most, most, 2), 0).T, labels


def stretch(points, labels, rng):
    """Objects are not always of the simulator's sizes and shapes; a slope along one direction does no harm either."""
    x, y, z = rng.uniform(0.9, 1.1), rng.uniform(0.9, 1.1), rng.uniform(0.85, 1.2)
    slope = rng.normal(0, 0.03, 2)
    shape = np.array([[x, 0, 0], [0, y, 0], [slope[0], slope[1], z]], np.float32)
    return points @ shape.T, labels


def warp(points, labels, rng, waves=5):
    """No surface is as flat as a simulated one: plane waves of random lengths bend everything, by at most a fifth in slope each."""
    changed = points.copy()
    for _ in range(waves):
        length = np.exp(rng.uniform(*LOG_WAVE))
        direction, towards = (v / np.linalg.norm(v) for v in rng.normal(size=(2, 3)))
        phase = points @ (2 * np.pi / length * direction).astype(np.float32) + np.float32(rng.uniform(0, 2 * np.pi))
        slope = rng.uniform(0, 0.2)
        changed += np.sin(phase)[..., None] * (slope * length / (2 * np.pi) * towards).astype(np.float32)
    return changed, labels


def rough_ground(points, labels, rng):
    """Grass and gravel: the ground of some columns is rough by centimetres, more so in some rows."""
    rows, columns = labels.shape
    sigma = rng.uniform(0, 0.05) * np.repeat(rng.random((rows, columns // 32)), 32, 1)
    lifted = points.copy()
    ground = labels[:, :sigma.shape[1]] == GROUND
    lifted[:, :sigma.shape[1], 2] += ground * np.abs(rng.normal(0, 1, sigma.shape)) * sigma
    return lifted, labels


def noise(points, labels, rng):
    """Range noise, beams whose ranges are all off by as much, and beams whose elevation is not quite what the calibration says."""
    distance = np.linalg.norm(points, axis=-1, keepdims=True)
    error = rng.normal(0, np.exp(rng.uniform(*LOG_NOISE)), distance.shape)
    error += rng.normal(0, np.exp(rng.uniform(*LOG_NOISE)), (len(points), 1, 1))
    points = points * (1 + error.astype(np.float32) / np.maximum(distance, 0.5))
    level = np.linalg.norm(points[..., :2], axis=-1)
    shift = rng.normal(0, rng.uniform(0, 0.003), (len(points), 1)).astype(np.float32)
    lifted = points.copy()
    lifted[..., 2] += level * shift
    return lifted, labels


def drop_out(points, labels, rng):
    """Lone pixels everywhere, and patches where a surface returns nothing (glass, wet asphalt, black paint)."""
    rows, columns = labels.shape
    gone = rng.random(labels.shape, np.float32) < rng.uniform(0, 0.12) ** 1.5
    for _ in range(rng.integers(0, 12)):
        height, width = rng.integers(1, max(2, rows // 6)), rng.integers(2, 40)
        r, c = rng.integers(rows), rng.integers(columns)
        gone[r:r + height, c:c + width] |= rng.random(gone[r:r + height, c:c + width].shape) < rng.uniform(0.3, 1)
    points, labels = points.copy(), labels.copy()
    points[gone] = np.nan
    labels[gone] = 255
    return points, labels


def own_body(points, labels, rng):
    """The vehicle that carries the sensor hides some of the lowest rows."""
    rows, columns = labels.shape
    points, labels = points.copy(), labels.copy()
    row, column = np.mgrid[:rows, :columns]
    for _ in range(rng.integers(1, 7)):
        height, width, centre = rng.uniform(1, rows / 5), rng.uniform(10, 70), rng.uniform(0, columns)
        foot = rng.uniform(0.75, 1.0) * rows
        away = np.abs(column - centre + rng.normal(0, 4, (rows, 1)))
        gone = (np.minimum(away, columns - away) / width) ** 2 + ((row - foot) / height) ** 2 < 1
        points[gone], labels[gone] = np.nan, 255
    return points, labels


def zigzag(points, labels, rng):
    """Lasers that do not look exactly where the azimuth says: some rows are a column aside."""
    shift = rng.integers(-1, 2, 2)
    rows = np.arange(len(points))
    for kind in range(2):
        of_kind = rows[(rows // 2) % 2 == kind]
        points[of_kind] = np.roll(points[of_kind], shift[kind], 1)
        labels[of_kind] = np.roll(labels[of_kind], shift[kind], 1)
    return points, labels


def augment(points, labels, rng):
    """One random view of a scan."""
    points, labels = roll(points, labels, rng)
    if rng.random() < 0.5:
        points, labels = mirror(points, labels)
    if rng.random() < 0.2:
        points, labels = zigzag(points.copy(), labels.copy(), rng)
    points, labels = noise(points, labels, rng)
    if rng.random() < 0.7:
        points, labels = stretch(points, labels, rng)
    if rng.random() < 0.6:
        points, labels = warp(points, labels, rng)
    if rng.random() < 0.3:
        points, labels = rough_ground(points, labels, rng)
    if rng.random() < 0.7:
        points, labels = tilt(points, labels, rng)
    if rng.random() < 0.4:
        points, labels = own_body(points, labels, rng)
    return drop_out(points, labels, rng)
