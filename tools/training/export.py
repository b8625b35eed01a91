"""Writes the averaged weights of a checkpoint as ONNX with the description that saker checks at start-up.

usage: export.py CHECKPOINT -o configs/models/segmentation.onnx --scenario configs/scenarios/training.yaml [--note KEY=VALUE …]
"""
import argparse
import hashlib
import pathlib
import subprocess

import torch
import yaml

import evaluation
import inputs
import labels as classes
import model as network

COLUMNS = 1024 + 2 * evaluation.PAD


def commit():
    here = pathlib.Path(__file__).resolve().parent
    return subprocess.run(["git", "-C", here, "rev-parse", "--short", "HEAD"], capture_output=True, text=True).stdout.strip()


def export(model, file):
    """Rows and columns are free: the network is convolutions only."""
    torch.onnx.export(network.folded(model), torch.zeros(1, model.config["channels"], 64, COLUMNS), str(file),
                      input_names=["features"], output_names=["scores"], opset_version=11)


def description(file, state, args):
    return {
        "classes": classes.CLASSES,
        "channels": inputs.CHANNEL_NAMES,
        "sha256": hashlib.sha256(file.read_bytes()).hexdigest(),
        "normalisation": "none: modules/segmentation/features.h gives values in about -3 ... 3",
        "rows": "any (trained on 64, 32 and 16)",
        "columns": "1024 or 512",
        "sensors": ["HDL-64E, simulated", "OS1-64, simulated"],
        "real_scans": "none",
        "scenario": args.scenario,
        "scenario_seed": args.scenario_seed,
        "scans": args.scans,
        "seed": state["seed"],
        "steps": state["step"],
        "widths": state["config"]["widths"],
        "commit": commit(),
        "licence": "BSD-3-Clause",
        **dict(note.split("=", 1) for note in args.note),
    }


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("checkpoint", type=pathlib.Path)
    parser.add_argument("-o", "--out", type=pathlib.Path, required=True)
    parser.add_argument("--scenario", required=True)
    parser.add_argument("--scenario-seed", type=int, nargs="+", default=[1])
    parser.add_argument("--scans", type=int, required=True, help="how many it was trained on")
    parser.add_argument("--note", nargs="*", default=[], metavar="KEY=VALUE", help="more of where they come from")
    args = parser.parse_args()
    args.out.parent.mkdir(parents=True, exist_ok=True)
    export(evaluation.load(args.checkpoint), args.out)
    text = yaml.safe_dump(description(args.out, torch.load(args.checkpoint, map_location="cpu"), args), sort_keys=False)
    args.out.with_suffix(".yaml").write_text("# Where the weights beside this come from; classes, channels and sha256 are checked at start-up.\n" + text)


if __name__ == "__main__":
    main()
