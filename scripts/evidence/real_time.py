"""Flights in real time by separate processes (scripts/fly): the median and the worst of several, never the quietest."""
import json
import os
import shutil
import statistics
import subprocess
import sys

from evidence.common import ROOT
from evidence.missions import ALL

SCENARIO = "configs/scenarios/demo.yaml"
SETTINGS = ("active.policy=saker", *ALL)
SEED = 1
LOOPS = ("guidance", "safety")
# Figures, and whether less is worse.
FIGURES = {"found": True, "mae_m": False, "trajectory_error_m": False, "trajectory_max_m": False, "collisions": False,
           "min_clearance_m": True, "flight_time_s": False, "path_m": False, "cpu": False, "checker_cpu": False, "simulator_cpu": False}


def command():
    return ["scripts/fly", SCENARIO, "OUT", str(SEED), *(part for setting in SETTINGS for part in ("--set", setting))]


def fly(programs, out):
    """The report of one flight; one that is there is not flown again."""
    report = out / "report/results.json"
    if not report.exists():
        words = [str(out) if word == "OUT" else word for word in command()]
        out.parent.mkdir(parents=True, exist_ok=True)
        with open(f"{out}.log", "w") as log:
            status = subprocess.run(words, cwd=ROOT, env={**os.environ, "SAKER_BIN": str(programs)}, stdout=log, stderr=log).returncode
        if status not in (0, 1) or not report.exists():
            sys.exit(f"{' '.join(words)}: status {status}: see {out}.log")
    return json.loads(report.read_text())


def figures_of(report):
    loops = {row["name"]: row for row in report["loops"]}
    late = {f"{name}_late": loops[name]["late"] / loops[name]["runs"] for name in LOOPS}
    worst = {f"{name}_worst_ms": loops[name]["worst_late_ms"] for name in LOOPS}
    return {"targets": report["targets"], **{key: report[key] for key in FIGURES}, **late, **worst}


def measure(programs, flights, out, pictures):
    runs = [figures_of(fly(programs, out / f"flight-{i + 1}")) for i in range(flights)]
    shutil.copy(out / "flight-1/report/map.png", pictures / "mission.png")
    column = lambda key: [run[key] for run in runs if run[key] is not None]
    keys = [key for key in runs[0] if column(key)]
    worst = lambda key: min(column(key)) if FIGURES.get(key, False) else max(column(key))
    return {"command": " ".join(command()), "flights": flights, "median": {key: statistics.median(column(key)) for key in keys},
            "worst": {key: worst(key) for key in keys}, "runs": runs}
