"""Trains the segmentation network on simulated scans.

usage: train.py SCANS -o OUT [--steps N] [--measure FOLDER …]

SCANS: what `saker simulate-scans configs/scenarios/training.yaml` wrote. The last twentieth of the scans is held out and measured every
few minutes, with the folders of --measure (never used for anything but that figure). OUT/checkpoint.pt is written every few minutes and
taken up again by the same command. Cross-entropy with class weights plus soft Dice, AdamW, one cycle, bfloat16, and an exponential
average of the weights, which is what is exported (export.py).
"""
import argparse
import copy
import math
import pathlib
import time

import numpy as np
import torch
import torch.nn.functional as F

import dataset
import evaluation
import inputs
import labels as classes
import model as network

CLASS_WEIGHTS = torch.tensor([1.0, 2.0, 2.5, 4.0, 0.8])
WEIGHT_RANGES = 5.0, 40.0  # m; between them a pixel counts by its range: far away a vehicle has few, and there the errors are
KIND_SHARE = 0.4  # of the loss of the finer outputs: which kind of vehicle it is matters less than that it is one


def class_scores(scores):
    """Log-odds of the classes from those of the outputs: probabilities of what is merged add up."""
    of = torch.from_numpy(classes.CLASS_OF)
    return torch.stack([scores[:, of == k].logsumexp(1) for k in range(len(classes.CLASSES))], 1)


def weights_of(values, truth):
    """How much each pixel counts: by its range, 0 where no label is known; mean 1 over the batch."""
    weight = (10 * values[:, inputs.LOG_RANGE].exp()).clamp(*WEIGHT_RANGES) * (truth != classes.IGNORED)
    return weight / weight.mean().clamp(min=1e-6)


def dice_of(scores, truth, weight):
    """Soft Dice over the batch, mean over the classes that are in it."""
    weight = weight.unsqueeze(1)
    probability = scores.softmax(1) * weight
    target = F.one_hot(truth, scores.shape[1]).permute(0, 3, 1, 2) * weight
    both, size = (probability * (target > 0)).sum((0, 2, 3)), (probability + target).sum((0, 2, 3))
    there = (target > 0).sum((0, 2, 3)) > 20
    return (1 - 2 * both / (size + 1))[there].mean()


def entropy_of(scores, truth, weight, of_class=None):
    """Cross-entropy, mean by the weights of pixels and, if given, of their classes."""
    entropy = F.cross_entropy(scores, truth, of_class, ignore_index=classes.IGNORED, label_smoothing=0.02, reduction="none")
    share = weight if of_class is None else weight * of_class[torch.where(truth == classes.IGNORED, 0, truth)]
    return (weight * entropy).sum() / share.sum().clamp(min=1e-6)


def loss_of(output, values, truth):
    """Cross-entropy and soft Dice of the classes, and a share of the cross-entropy of the outputs."""
    scores = network.scores(output).float()
    merged_scores = class_scores(scores)
    weight = weights_of(values, truth)
    merge = torch.from_numpy(classes.merged(np.arange(256, dtype=np.uint8)).astype(np.int64)).to(truth.device)
    merged = merge[truth]
    dice = dice_of(merged_scores, torch.where(truth != classes.IGNORED, merged, 0), weight)
    return entropy_of(merged_scores, merged, weight, CLASS_WEIGHTS.to(truth.device)) + dice + KIND_SHARE * entropy_of(scores, truth, weight)


def rate(step, steps, highest):
    """Warm-up, then half a cosine."""
    warm = min(300, steps // 10)
    if step < warm:
        return highest * (step + 1) / warm
    return highest * 0.5 * (1 + math.cos(math.pi * (step - warm) / (steps - warm)))


class Trainer:
    def __init__(self, args):
        self.args = args
        torch.manual_seed(args.seed)
        self.model = network.RangeNet(inputs.CHANNELS, len(classes.OUTPUTS), args.widths).to(args.device, memory_format=torch.channels_last)
        self.average = copy.deepcopy(self.model).eval()
        self.optimizer = torch.optim.AdamW(self.model.parameters(), lr=args.rate, weight_decay=0.01)
        self.step = 0
        self.seconds = 0.0
        self.plans = []  # [first step, steps planned from there on]: more than one where a run was taken up with another --steps
        self.checkpoint = args.out / "checkpoint.pt"
        if self.checkpoint.exists():
            self._resume()
        elif args.start:
            self.model.load_state_dict(torch.load(args.start, map_location=args.device)["average"])
            self.average.load_state_dict(self.model.state_dict())
        self._plan()

    def _plan(self):
        if not self.plans or self.plans[-1][1] != self.args.steps:
            self.plans.append([self.step, self.args.steps])

    def _resume(self):
        state = torch.load(self.checkpoint, map_location=self.args.device)
        self.seconds = state["seconds"]
        self.plans = state.get("plans", [[0, state["steps"]]])
        self.step = state["step"]
        self.model.load_state_dict(state["model"])
        self.average.load_state_dict(state["average"])
        self.optimizer.load_state_dict(state["optimizer"])

    def save(self):
        state = {"step": self.step, "config": self.model.config, "model": self.model.state_dict(),
                 "average": self.average.state_dict(), "optimizer": self.optimizer.state_dict(),
                 "seed": self.args.seed, "steps": self.args.steps, "scans": len(dataset.files(self.args.scans)),
                 "seconds": self.seconds, "device": self.args.device, "batch": self.args.batch, "rate": self.args.rate, "plans": self.plans}
        temporary = self.checkpoint.with_suffix(".new")
        torch.save(state, temporary)
        temporary.replace(self.checkpoint)

    def train_batch(self, values, truth):
        for group in self.optimizer.param_groups:
            group["lr"] = rate(self.step, self.args.steps, self.args.rate)
        self.model.train()
        values, truth = values.to(self.args.device, memory_format=torch.channels_last), truth.to(self.args.device)
        with torch.autocast(self.args.device, dtype=torch.bfloat16):
            output = self.model(values)
        loss = loss_of(output, values, truth)
        self.optimizer.zero_grad()
        loss.backward()
        torch.nn.utils.clip_grad_norm_(self.model.parameters(), 5.0)
        self.optimizer.step()
        self.step += 1
        self._update_average()
        return loss.item()

    def _update_average(self):
        keep = min(0.998, (self.step + 1) / (self.step + 20))
        with torch.no_grad():
            for mean, value in zip(self.average.state_dict().values(), self.model.state_dict().values()):
                if mean.dtype.is_floating_point:
                    mean.lerp_(value, 1 - keep)
                else:
                    mean.copy_(value)

    def measure(self, held_out):
        print(f"step {self.step} held out: {evaluation.report(evaluation.evaluate(self.average, held_out))}", flush=True)
        for folder in self.args.measure:
            figures = evaluation.report(evaluation.evaluate(self.average, dataset.files(folder)))
            print(f"step {self.step} {folder}: {figures}", flush=True)


def batches(args, first):
    images = dataset.Images(args.scans)
    chosen = [i for i in range(dataset.trained(len(images))) if images.sizes[i, 0] >= dataset.LEAST_ROWS]
    data = dataset.Batches(images, chosen, args.batch, args.width, args.seed)
    return torch.utils.data.DataLoader(data, batch_size=None, sampler=range(first, args.steps), num_workers=args.workers,
                                       prefetch_factor=4 if args.workers else 2)


def run(args):
    args.out.mkdir(parents=True, exist_ok=True)
    torch.set_num_threads(args.threads)
    trainer = Trainer(args)
    held_out = dataset.held_out(args.scans)
    mean, saved = None, time.time()
    began, before = time.time(), trainer.seconds
    for values, truth in batches(args, trainer.step):
        loss = trainer.train_batch(values, truth)
        mean = loss if mean is None else 0.98 * mean + 0.02 * loss
        trainer.seconds = before + time.time() - began
        if trainer.step % 100 == 0:
            print(f"step {trainer.step} of {args.steps}: loss {mean:.4f}, {time.strftime('%H:%M:%S')}", flush=True)
        if time.time() - saved > args.save_every or trainer.step == args.steps:
            trainer.save()
            trainer.measure(held_out)
            saved = time.time()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scans", type=pathlib.Path)
    parser.add_argument("-o", "--out", type=pathlib.Path, required=True)
    parser.add_argument("--start", type=pathlib.Path, help="checkpoint of another run to start from")
    parser.add_argument("--steps", type=int, default=24000)
    parser.add_argument("--batch", type=int, default=4)
    parser.add_argument("--width", type=int, default=512, help="columns of a crop")
    parser.add_argument("--rate", type=float, default=2e-3)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--workers", type=int, default=1)
    parser.add_argument("--widths", type=int, nargs=5, default=[16, 32, 64, 96, 128])
    parser.add_argument("--device", default="cuda" if torch.cuda.is_available() else "cpu")
    parser.add_argument("--save-every", type=float, default=240, help="s")
    parser.add_argument("--measure", type=pathlib.Path, nargs="*", default=[], help="folders of labelled scans to measure on")
    run(parser.parse_args())


if __name__ == "__main__":
    main()
