"""pieces.py MODEL.yaml PIECES.csv…: what `saker evaluate --pieces` left of labelled scans → `cylinders` in the network's description, the
weights by which a piece is a trunk (crowned), a pole (bare) or neither: modules/segmentation/cylinder_pieces.h.

The weights are those of greatest likelihood, ln L = Σ over pieces of pixels^(power - 1) · Σ over kinds of pixels labelled so · ln P(kind): with
power 1 each pixel counts, with 0 each piece. The power is that of the highest mean IoU of trunks and poles on pieces of worlds held out."""

import argparse
import csv
import pathlib
import re

import numpy as np

KINDS = ("crowned", "bare", "neither")
POWERS = (0.0, 0.5, 1.0)
FOLDS = 5
SCANS_OF_A_WORLD = 4  # configs/scenarios/training.yaml
STEPS, ENOUGH = 100, 1e-10  # of Newton's method; the gain of the mean log-likelihood that is none
RIDGE = 1e-6  # of the Hessian of the mean: features that depend on each other


def read(files):
    """Names of the features, features (n, d), pixels by kind (n, 3), number of each piece's world."""
    features, pixels, worlds = [], [], []
    for number, file in enumerate(files):
        with file.open() as lines:
            names, *rows = csv.reader(lines)
        for scan, *values in rows:
            features.append(values[:-len(KINDS)])
            pixels.append(values[-len(KINDS):])
            worlds.append(number + int(re.sub(r"\D", "", scan) or 0) // SCANS_OF_A_WORLD)
    return names[1:-len(KINDS)], np.array(features, float), np.array(pixels, float), np.array(worlds)


def probabilities(features, weights):
    """Of trunk, pole, neither."""
    scores = np.column_stack([features @ weights.T, np.zeros(len(features))])
    shares = np.exp(scores - scores.max(1, keepdims=True))
    return shares / shares.sum(1, keepdims=True)


def mean_log_likelihood(features, counts, weights):
    return (counts * np.log(probabilities(features, weights) + 1e-300)).sum() / counts.sum()


def newton_step(features, counts, weights):
    total, d = counts.sum(1), features.shape[1]
    p = probabilities(features, weights)[:, :2]
    gradient = (counts[:, :2] - total[:, None] * p).T @ features / total.sum()
    hessian = RIDGE * np.eye(2 * d)
    for a in range(2):
        for b in range(2):
            curvature = total * p[:, a] * ((a == b) - p[:, b])
            hessian[a * d:(a + 1) * d, b * d:(b + 1) * d] += features.T @ (curvature[:, None] * features) / total.sum()
    return np.linalg.solve(hessian, gradient.ravel()).reshape(2, d)


def fit(features, counts):
    """Weights (2, d) of trunk and pole."""
    weights = np.zeros((2, features.shape[1]))
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
    """Of trunks and poles, over the pixels of all pieces."""
    called = p.argmax(1)
    right = [pixels[called == k, k].sum() for k in range(2)]
    return [r / max(pixels[:, k].sum() + pixels[called == k].sum() - r, 1) for k, r in enumerate(right)]


def block(names, weights, facts):
    lines = ["cylinders:"]
    for kind, row in zip(KINDS, weights):
        lines += [f"  {kind}:"] + [f"    {name}: {value:.4f}" for name, value in zip(names, row)]
    return "\n".join(lines + [f"  {key}: {value}" for key, value in facts.items()]) + "\n"


def replaced(text, found):
    """The description with the block at its end."""
    text = re.sub(r"^cylinders:\n(  .*\n)*", "", text.rstrip("\n") + "\n", flags=re.MULTILINE)
    return text + found


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("model", type=pathlib.Path)
    parser.add_argument("pieces", type=pathlib.Path, nargs="+")
    parser.add_argument("--scans", required=True, help="what they were taken from, for the description")
    arguments = parser.parse_args()
    names, features, pixels, worlds = read(arguments.pieces)
    figures = {power: iou(pixels, held_out(features, pixels, worlds, power)) for power in POWERS}
    for power, (trunk, pole) in figures.items():
        print(f"pixels to the power of {power}: held-out IoU within pieces: trunk {trunk:.3f}, pole {pole:.3f}")
    power = max(figures, key=lambda power: sum(figures[power]))
    facts = {"power": power, "pieces": len(pixels), "scans": arguments.scans,
             "held_out_iou": "[{:.3f}, {:.3f}]".format(*figures[power])}
    found = block(names, fit(features, weighted(pixels, power)), facts)
    arguments.model.write_text(replaced(arguments.model.read_text(), found))
    print(found, end="")


if __name__ == "__main__":
    main()
