"""Intersection over union of the network, per point, on labelled scans.

usage: evaluation.py CHECKPOINT FOLDER [--save OUT]
"""
import argparse
import pathlib

import numpy as np
import torch

import dataset
import inputs
import labels as classes
import model as network

PAD = 16  # columns that wrap around at each side, as in modules/segmentation/network.cc


def padded(values):
    """The columns wrap around; rows are filled up to a multiple of 16, columns of 32."""
    rows = -values.shape[1] % 16
    values = np.pad(values, ((0, 0), (0, rows), (0, 0)))
    values = np.concatenate([values[:, :, -PAD:], values, values[:, :, :PAD]], 2)
    return np.pad(values, ((0, 0), (0, 0), (0, -values.shape[2] % 32)))


def predict(model, image):
    """Class of each pixel: the probabilities of the outputs that are merged into one add up."""
    return class_probability(scores_of(model, image)).argmax(0).astype(np.uint8)


def scores_of(model, image):
    """Scores of the outputs (outputs, rows, columns)."""
    values = padded(inputs.features(image))
    device = next(model.parameters()).device
    with torch.no_grad(), torch.autocast(device.type, dtype=torch.bfloat16):
        scores = network.scores(model(torch.from_numpy(values)[None].to(device)))
    return scores[0, :, :image.shape[0], PAD:PAD + image.shape[1]].float().cpu()


def class_probability(scores):
    """(classes, rows, columns) of scores of the outputs."""
    probability = scores.softmax(0).numpy()
    return np.stack([probability[classes.CLASS_OF == k].sum(0) for k in range(len(classes.CLASSES))])


def temperature(model, files):
    """By which the scores are divided so that the probability of the class is right on `files`: Guo et al., "On Calibration of Modern
    Neural Networks", ICML 2017; the likeliest of a grid."""
    grid = np.exp(np.linspace(-0.7, 0.7, 29))
    loss = np.zeros(len(grid))
    for scan, truth in files:
        image, label, _ = dataset.image_of(*dataset.read_scan(scan, truth), dataset.read_rings(scan))
        scores = scores_of(model, image)
        wanted = classes.merged(label)
        row, column = np.nonzero(wanted != classes.IGNORED)
        for k, t in enumerate(grid):
            own = class_probability(scores / t)[wanted[row, column], row, column]
            loss[k] -= np.log(np.maximum(own, 1e-6)).sum()
    return float(grid[loss.argmin()])


def confusion(predicted, truth):
    keep = truth != classes.IGNORED
    n = len(classes.CLASSES)
    return np.bincount(truth[keep].astype(int) * n + predicted[keep], minlength=n * n).reshape(n, n)


def intersection_over_union(total):
    hit = np.diag(total)
    return hit / np.maximum(total.sum(0) + total.sum(1) - hit, 1)


def report(total):
    return "  ".join(f"{name} {iou:.3f}" for name, iou in zip(classes.CLASSES, intersection_over_union(total)))


def evaluate(model, files, save=None):
    """Confusion over the points of the scans; a point has the class of its pixel."""
    total = np.zeros((len(classes.CLASSES),) * 2, np.int64)
    for scan, truth in files:
        points, label = dataset.read_scan(scan, truth)
        image, _, pixel = dataset.image_of(points, label, dataset.read_rings(scan))
        predicted = np.where(pixel >= 0, predict(model, image).ravel()[np.maximum(pixel, 0)], 0).astype(np.uint8)
        total += confusion(predicted, classes.merged(label))
        if save:
            (save / "labels").mkdir(parents=True, exist_ok=True)
            classes.WRITTEN[predicted].tofile(save / "labels" / truth.name)
    return total


def load(checkpoint):
    """The averaged weights of a checkpoint of training.py."""
    state = torch.load(checkpoint, map_location="cpu")
    model = network.RangeNet(**state["config"])
    model.load_state_dict(state["average"])
    return model.eval()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("checkpoint")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--save", type=pathlib.Path, help="folder for the predicted labels")
    args = parser.parse_args()
    print(report(evaluate(load(args.checkpoint), dataset.files(args.folder), args.save)))


if __name__ == "__main__":
    main()
