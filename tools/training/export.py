"""Writes the averaged weights of a checkpoint as ONNX with the description that saker checks at start-up.

usage: export.py CHECKPOINT -o configs/models/segmentation.onnx --scans SCANS --scenario FILE --scenario-seed N

The scores are calibrated: divided by the temperature at which the probabilities are right on the scans that the training held out.
Every number of the description comes from the checkpoint or is measured here.
"""
import argparse
import hashlib
import pathlib

import torch
import yaml

import dataset
import evaluation
import inputs
import labels as classes
import model as network

COLUMNS = 1024 + 2 * evaluation.PAD
HEADER = "# Where the weights beside this come from; outputs, classes, channels and sha256 are checked at start-up.\n"


def export(model, file):
    """Rows and columns are free: the network is convolutions only."""
    torch.onnx.export(network.folded(model), torch.zeros(1, model.config["channels"], 64, COLUMNS), str(file),
                      input_names=["features"], output_names=["scores"], opset_version=11)


def calibrate(model, held_out):
    """Folds the temperature into the head. \\return it"""
    t = evaluation.temperature(model, held_out)
    with torch.no_grad():
        model.head.weight /= t
        model.head.bias /= t
    return t


def description(file, state, figures, args):
    return {
        "outputs": classes.OUTPUTS,
        "classes": [name for _, name, _ in classes.TABLE],
        "channels": inputs.CHANNEL_NAMES,
        "sha256": hashlib.sha256(file.read_bytes()).hexdigest(),
        "normalisation": "none: modules/segmentation/features.h gives values in about -3 ... 3",
        "real_scans": args.real_scans,
        "scenario": args.scenario,
        "scenario_seed": args.scenario_seed,
        "scans": state["scans"],
        "seed": state["seed"],
        "steps": state["step"],
        "plans": state["plans"],
        "batch": state["batch"],
        "rate": state["rate"],
        "widths": state["config"]["widths"],
        "hours": round(state["seconds"] / 3600, 2),
        "device": state["device"],
        "temperature": round(figures["temperature"], 3),
        "held_out_iou": figures["iou"],
        "licence": "BSD-3-Clause",
    }


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("checkpoint", type=pathlib.Path)
    parser.add_argument("-o", "--out", type=pathlib.Path, required=True)
    parser.add_argument("--scans", type=pathlib.Path, required=True, help="the folder that it was trained on")
    parser.add_argument("--scenario", required=True)
    parser.add_argument("--scenario-seed", type=int, required=True)
    parser.add_argument("--real-scans", default="none", help="what of the scans was no simulation")
    args = parser.parse_args()
    torch.set_num_threads(1)
    model = evaluation.load(args.checkpoint)
    held_out = dataset.held_out(args.scans)
    figures = {"temperature": calibrate(model, held_out)}
    iou = evaluation.intersection_over_union(evaluation.evaluate(model, held_out))
    figures["iou"] = {name: round(float(value), 3) for name, value in zip(classes.CLASSES, iou)}
    args.out.parent.mkdir(parents=True, exist_ok=True)
    export(model, args.out)
    text = yaml.safe_dump(description(args.out, torch.load(args.checkpoint, map_location="cpu"), figures, args), sort_keys=False)
    args.out.with_suffix(".yaml").write_text(HEADER + text)


if __name__ == "__main__":
    main()
