"""Missions in lockstep: the policies side by side in the same worlds, and a team."""
import json
import math
import subprocess
import sys

from evidence.common import ROOT

SCENARIOS = ("demo", "urban2", "urban3", "lots", "garage", "dirt_road")

# What is compared: a policy, or one with settings of its own. `saker` is compared with those before it.
VARIANTS = {
    "visit": "active.policy=visit",
    # As much time as `saker` or more: two opposite corners of each vehicle of the prior map, from which all its edges are seen, for three
    # windows each. With vehicles that are met beside them and five windows it takes twice that.
    "sides": "active.policy=visit active.visit.sides=2 active.visit.oblique_worth_m=10 active.visit.dwell_s=1.5 active.discovery.most=0",
    # All views that the model has seen flown, where the default keeps the best quarter of them and of that its centroids.
    "paper": "active.policy=paper active.region.best_share=1 active.paper.sampling=uniform",
    "saker": "active.policy=saker",
}
ALL = ("slam.measurement_noise=fitted",)  # of every variant: they differ in where they fly alone

ROW = ("runs", "succeeded", "targets", "found", "reachable", "reachable_found", "mapped_share", "mae_m", "bias_m", "sd_m", "length", "width",
       "size_nees", "place_nees", "collisions", "min_clearance_m", "trajectory_error_m", "flight_time_s", "path_m", "classes")


def settings():
    return [part for setting in ALL for part in ("--set", setting)]


def shown(command):
    return " ".join(f'"{part}"' if " " in part else part for part in map(str, command))


def fly(saker, *command, threads, out):
    """Progress goes on to the terminal. Status 1, a mission that falls short, is a figure and no failure."""
    status = subprocess.run([saker, *map(str, command), "--threads", str(threads), "-o", out], cwd=ROOT,
                            stdout=subprocess.DEVNULL).returncode
    if status not in (0, 1):
        sys.exit(f"saker {command[0]}: status {status}")
    return json.loads((out / "results.json").read_text())


def predicted(bins):
    """Realised over predicted error of all viewpoints, and of each bin by rising prediction."""
    sums = [sum(b["outcomes"] * b[key] ** 2 for b in bins) for key in ("realised_m", "predicted_m")]
    return {"outcomes": sum(b["outcomes"] for b in bins), "realised_over_predicted": math.sqrt(sums[0] / sums[1]),
            "bins": [b["ratio"] for b in bins]}


def compared(comparisons, scenario):
    """{policy that saker is compared with: {figure: its ratio with interval and verdict}}"""
    rows = [c for c in comparisons if c["scenario"] == scenario and c["policy"] == "saker"]
    return {c["against"]: {key: {**{k: f["ratio"][k] for k in ("estimate", "low", "high")}, "verdict": f["verdict"]}
                           for key, f in c["figures"].items() if key in ("mae_m", "sd_m", "flight_time_s")} for c in rows}


def measure(saker, seeds, scenarios, variants, threads, out):
    files = [f"configs/scenarios/{name}.yaml" for name in scenarios]
    named = [part for name in variants for part in ("--variant", f"{name} {VARIANTS[name]}")]
    command = ("experiment", *files, "--seed", seeds[0], "--runs", len(seeds), *named, *settings())
    said = fly(saker, *command, threads=threads, out=out)
    rows = {(row["scenario"], row["policy"]): {key: row[key] for key in ROW} for row in said["table"]}
    pool = "all" if len(scenarios) > 1 else scenarios[0]
    entry = {"command": f"saker {shown(command)} -o OUT", "variants": {name: VARIANTS[name] for name in variants}}
    for name in variants:
        entry[name] = rows[pool, name]
        if said["calibration"].get(name):
            entry[name]["predictions"] = predicted(said["calibration"][name])
    entry["saker_against"] = compared(said["comparisons"], pool)
    entry["scenarios"] = {where: {name: rows[where, name] for name in variants} for where in scenarios}
    return entry


def measure_team(saker, seeds, threads, out):
    command = ("mission", "configs/missions/lots.yaml", "--seed", seeds[0], "--runs", len(seeds))
    said = fly(saker, *command, threads=threads, out=out)
    keys = ("runs", "targets", "found", "collisions", "bias_m")
    robots = {row["robot"]: {**{key: row[key] for key in keys}, "busy_s": row["busy_s"] / row["runs"],
                             **{key: row[key]["estimate"] for key in ("objects_per_min", "sd_m", "mae_m")}} for row in said["table"]}
    mean = next(c for c in said["comparisons"] if c["against"] == "robots' mean")
    ratios = {key: mean["figures"][key]["ratio"]["estimate"] for key in ("objects_per_min", "mae_m", "sd_m")}
    return {"command": f"saker {shown(command)} -o OUT", "robots": robots, "together_over_mean": ratios}
