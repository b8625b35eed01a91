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
    """The columns wrap around; rows are filled up to a multiple of 8."""
    rows = -values.shape[1] % 8
    values = np.pad(values, ((0, 0), (0, rows), (0, 0)))
    return np.concatenate([values[:, :, -PAD:], values, values[:, :, :PAD]], 2)


def predict(model, image):
    """Class of each pixel."""
    values = padded(inputs.features(image))
    with torch.no_grad(), torch.cpu.amp.autocast(dtype=torch.bfloat16):
        scores = network.scores(model(torch.from_numpy(values)[None]))
    return scores[0, :, :image.shape[0], PAD:PAD + image.shape[1]].float().argmax(0).numpy().astype(np.uint8)


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
        image, _, pixel = dataset.image_of(points, label)
        predicted = np.where(pixel >= 0, predict(model, image).ravel()[np.maximum(pixel, 0)], 0).astype(np.uint8)
        total += confusion(predicted, label)
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
