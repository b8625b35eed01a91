"""Simulated flights, mapped from their captures, and all maps compared with the truth at once."""
import json
import statistics

from evidence.common import run

APART_M = 10_000
LEAST_POINTS = 100  # returns: with fewer a true object was not there to be seen
SCENARIO = "configs/scenarios/flight.yaml"


def fly(saker, seed, out):
    """What `saker replay` says; what is there already is not made again."""
    flight, mapped = out / "flight", out / "map"
    if not (mapped / "results.json").exists():
        out.mkdir(parents=True, exist_ok=True)
        run(saker, "simulate-scans", SCENARIO, "--seed", seed, "-o", flight, "--force")
        run(saker, "replay", flight / "flight.pcap", "--truth", flight / "truth.json", "-o", mapped, "--force", good=(0, 1))
        for capture in flight.glob("*.pcap"):
            capture.unlink()
    return json.loads((mapped / "results.json").read_text())


def shifted(file, index):
    """The objects of a map, moved by the flight's place in the row, with ids of their own."""
    objects = json.loads(file.read_text())["objects"]
    for item in objects:
        item["id"] += index * 100_000
        item["position" if "position" in item else "root"][0] += index * APART_M
    return objects


def pooled(saker, flights, out):
    """`saker map eval` of the maps laid side by side, 10 km apart."""
    for name, file in (("map", "map/map.json"), ("truth", "flight/truth.json")):
        objects = [item for i, flight in enumerate(flights) for item in shifted(flight / file, i)]
        (out / f"{name}.json").write_text(json.dumps({"frame": "world", "objects": objects, "ground": []}))
    return json.loads(run(saker, "map", "eval", out / "map.json", out / "truth.json", "--min-points", LEAST_POINTS, "--json"))


def measure(saker, seeds, out):
    folders = [out / f"seed-{seed}" for seed in seeds]
    said = [fly(saker, seed, folder) for seed, folder in zip(seeds, folders)]
    errors = [row["trajectory"]["position_rmse_m"] for row in said]
    classes = {name: row for name, row in pooled(saker, folders, out).items() if row["truth"] + row["mapped"]}
    return {"command": f"saker simulate-scans {SCENARIO} --seed N -o FLIGHT; saker replay FLIGHT/flight.pcap -o MAP; "
                       f"saker map eval MAP TRUTH --min-points {LEAST_POINTS}",
            "flights": len(seeds),
            "trajectory_m": {"median": statistics.median(errors), "worst": max(errors)},
            "real_time_factor": min(row["real_time_factor"] for row in said),
            "classes": {name: {key: row[key] for key in ("truth", "found", "mapped", "invented", "duplicates", "size_mae_m",
                                                         "constant_size_mae_m", "length_slope", "nees") if key in row}
                        for name, row in classes.items()}}
