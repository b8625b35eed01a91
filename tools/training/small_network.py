"""Writes the small network at random of tests/segmentation/network_test.cc, an input, and PyTorch's output.

usage: small_network.py tests/segmentation/small
"""
import pathlib
import sys

import numpy as np
import torch

import evaluation
import export
import inputs
import labels as classes
import model as network

ROWS, COLUMNS = 10, 64


def random_network(channels):
    torch.manual_seed(1)
    model = network.RangeNet(channels, len(classes.OUTPUTS), (6, 8, 8, 12, 12))
    for layer in model.modules():
        if isinstance(layer, torch.nn.BatchNorm2d):
            torch.nn.init.normal_(layer.bias, 0, 0.2)
            torch.nn.init.normal_(layer.running_mean, 0, 0.2)
    torch.nn.init.normal_(model.head.weight, 0, 0.5)
    return model.eval()


def main():
    folder = pathlib.Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    model = random_network(inputs.CHANNELS)
    values = np.random.default_rng(1).normal(size=(inputs.CHANNELS, ROWS, COLUMNS)).astype(np.float32)
    with torch.no_grad():
        scores = network.scores(model(torch.from_numpy(evaluation.padded(values))[None]))[0]
    pad = evaluation.PAD
    probability = evaluation.class_probability(scores[:, :ROWS, pad:pad + COLUMNS])
    values.tofile(folder / "features.f32")
    np.ascontiguousarray(probability.transpose(1, 2, 0)).tofile(folder / "probabilities.f32")
    export.export(model, folder / "network.onnx")


if __name__ == "__main__":
    main()
