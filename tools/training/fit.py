"""fit.py LABELS MODEL.yaml: what `saker segment` left of held-out scans → `fit` in the network's description: the hundredth part of
the scans that is least sure. A recording below it is unlike anything the network was trained for."""

import argparse
import pathlib
import re

import numpy as np

PERCENT = 1
OTHER = 99  # label of `other` (configs/models/classes.yaml)


def figures(labels):
    """Mean probability and share of classified points of each scan."""
    probability, classified = [], []
    for file in sorted((labels / "labels").glob("*.label")):
        ids = np.fromfile(file, np.uint32)
        certainty = np.fromfile(labels / "probability" / (file.stem + ".f32"), np.float32)
        if not len(ids):
            continue
        probability.append(certainty.mean())
        classified.append((ids != OTHER).mean())
    return np.array(probability), np.array(classified)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("labels", type=pathlib.Path)
    parser.add_argument("model", type=pathlib.Path)
    parser.add_argument("--worlds", type=int)
    parser.add_argument("--seed", type=int)
    arguments = parser.parse_args()
    probability, classified = figures(arguments.labels)
    fit = (f"fit:\n  least_probability: {np.percentile(probability, PERCENT):.3f}\n"
           f"  least_classified_share: {np.percentile(classified, PERCENT):.3f}\n"
           f"  scans: {len(probability)}\n  worlds: {arguments.worlds}\n  seed: {arguments.seed}\n")
    text = arguments.model.read_text()
    text = re.sub(r"^fit:\n(  .*\n)*", "", text, flags=re.MULTILINE)
    arguments.model.write_text(text.rstrip("\n") + "\n" + fit)
    print(fit, end="")
    print(f"medians: {np.median(probability):.3f}, {np.median(classified):.3f}")


if __name__ == "__main__":
    main()
