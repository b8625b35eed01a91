"""pieces.py MODEL.yaml TABLE.csv…: what `saker evaluate --pieces` left of labelled scans (cylinders.csv or vehicles.csv) → a block of that
name in the network's description, the weights by which a piece is a trunk (crowned), a pole (bare) or neither; a vehicle or not:
modules/segmentation/object_pieces.h.

The weights are those of greatest likelihood, ln L = Σ over pieces of pixels^(power - 1) · Σ over kinds of pixels labelled so · ln P(kind): with
power 1 each pixel counts, with 0 each piece. The power is that of the highest mean IoU of the kinds on pieces of worlds held out."""

import argparse
import csv
import pathlib
import re

import numpy as np

FAMILIES = {"cylinders": ("crowned", "bare", "neither"), "vehicles": ("vehicle", "neither")}
POWERS = (0.0, 0.5, 1.0)
FOLDS = 5
SCANS_OF_A_WORLD = 4  # configs/scenarios/training.yaml
STEPS, ENOUGH = 100, 1e-10  # of Newton's method; the gain of the mean log-likelihood that is none
RIDGE = 1e-6  # of the Hessian of the mean: features that depend on each other


def family_of(names):
    """Name and kinds of the family that a table is of, by its last columns."""
    for family, kinds in FAMILIES.items():
        if tuple(names[-len(kinds):]) == kinds:
            return family, kinds
    raise SystemExit(f"pieces.py: columns {','.join(names)}: expected those of {' or '.join(FAMILIES)}")


def read(files):
    """Family, names of the features, features (n, d), pixels by kind (n, kinds), number of each piece's world."""
    features, pixels, worlds = [], [], []
    for number, file in enumerate(files):
        with file.open() as lines:
            names, *rows = csv.reader(lines)
        family, kinds = family_of(names)
        for scan, *values in rows:
            features.append(values[:-len(kinds)])
            pixels.append(values[-len(kinds):])
            worlds.append(number + int(re.sub(r"\D", "", scan) or 0) // SCANS_OF_A_WORLD)
    return family, names[1:-len(kinds)], np.array(features, float), np.array(pixels, float), np.array(worlds)


def probabilities(features, weights):
    """Of each kind, neither last."""
    scores = np.column_stack([features @ weights.T, np.zeros(len(features))])
    shares = np.exp(scores - scores.max(1, keepdims=True))
    return shares / shares.sum(1, keepdims=True)


def mean_log_likelihood(features, counts, weights):
    return (counts * np.log(probabilities(features, weights) + 1e-300)).sum() / counts.sum()


def newton_step(features, counts, weights):
    total, (kinds, d) = counts.sum(1), weights.shape
    p = probabilities(features, weights)[:, :kinds]
    gradient = (counts[:, :kinds] - total[:, None] * p).T @ features / total.sum()
    hessian = RIDGE * np.eye(kinds * d)
    for a in range(kinds):
        for b in range(kinds):
            curvature = total * p[:, a] * ((a == b) - p[:, b])
            hessian[a * d:(a + 1) * d, b * d:(b + 1) * d] += features.T @ (curvature[:, None] * features) / total.sum()
    return np.linalg.solve(hessian, gradient.ravel()).reshape(kinds, d)


def fit(features, counts):
    """Weights (kinds but neither, d)."""
    weights = np.zeros((counts.shape[1] - 1, features.shape[1]))
    reached = mean_log_likelihood(features, counts, weights)
    for _ in range(STEPS):
        step, length = newton_step(features, counts, weights), 1.0
        while length > 1e-6 and mean_log_likelihood(features, counts, weights + length * step) < reached:
            length /= 2
        weights = weights + length * step
        before, reached = reached, mean_log_likelihood(features, counts, weights)
        if reached - before < ENOUGH:
            break
    return weights


def weighted(pixels, power):
    return pixels / np.maximum(pixels.sum(1, keepdims=True), 1) ** (1 - power)


def held_out(features, pixels, worlds, power):
    """Probabilities of each piece by a fit to the other folds' worlds."""
    counts, p = weighted(pixels, power), np.zeros_like(pixels)
    for fold in range(FOLDS):
        out = worlds % FOLDS == fold
        p[out] = probabilities(features[out], fit(features[~out], counts[~out]))
    return p


def iou(pixels, p):
    """Of each kind but neither, over the pixels of all pieces."""
    called = p.argmax(1)
    right = [pixels[called == k, k].sum() for k in range(pixels.shape[1] - 1)]
    return [r / max(pixels[:, k].sum() + pixels[called == k].sum() - r, 1) for k, r in enumerate(right)]


def block(family, names, weights, facts):
    lines = [f"{family}:"]
    for kind, row in zip(FAMILIES[family], weights):
        lines += [f"  {kind}:"] + [f"    {name}: {value:.4f}" for name, value in zip(names, row)]
    return "\n".join(lines + [f"  {key}: {value}" for key, value in facts.items()]) + "\n"


def replaced(text, family, found):
    """The description with the block at its end."""
    text = re.sub(rf"^{family}:\n(  .*\n)*", "", text.rstrip("\n") + "\n", flags=re.MULTILINE)
    return text + found


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("model", type=pathlib.Path)
    parser.add_argument("pieces", type=pathlib.Path, nargs="+")
    parser.add_argument("--scans", required=True, help="what they were taken from, for the description")
    arguments = parser.parse_args()
    family, names, features, pixels, worlds = read(arguments.pieces)
    figures = {power: iou(pixels, held_out(features, pixels, worlds, power)) for power in POWERS}
    for power, ious in figures.items():
        said = ", ".join(f"{kind} {value:.3f}" for kind, value in zip(FAMILIES[family], ious))
        print(f"pixels to the power of {power}: held-out IoU within pieces: {said}")
    power = max(figures, key=lambda power: sum(figures[power]))
    facts = {"power": power, "pieces": len(pixels), "scans": arguments.scans,
             "held_out_iou": "[" + ", ".join(f"{value:.3f}" for value in figures[power]) + "]"}
    found = block(family, names, fit(features, weighted(pixels, power)), facts)
    arguments.model.write_text(replaced(arguments.model.read_text(), family, found))
    print(found, end="")


if __name__ == "__main__":
    main()
