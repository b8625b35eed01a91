"""Whole missions by `saker experiment`, in lockstep, one thread."""

import json
import os
import pathlib
import subprocess
import time

SCENARIOS = pathlib.Path(__file__).resolve().parents[2] / "configs" / "scenarios"


def command(scenario, out, *more):
    return [os.environ["SAKER"], "experiment", str(SCENARIOS / f"{scenario}.yaml"), "-o", str(out),
            "--threads", "1", *map(str, more)]


def fly(scenario, out, *more, deadline_s=3600):
    """Results of a mission; how fast it ran is printed."""
    run = subprocess.run(command(scenario, out, *more), capture_output=True, text=True,
                         stdin=subprocess.DEVNULL, timeout=deadline_s)
    if run.returncode == 2:
        raise AssertionError(run.stderr)
    results = json.loads((pathlib.Path(out) / "results.json").read_text())
    if "real_time_factor" in results:
        print(f"{scenario}: {results['real_time_factor']:.2f} times real time", flush=True)
    return results


def memory_of(scenario, out, *more, every_s=1):
    """Resident memory, kB, at equal steps of wall time while a mission is flown; and its results."""
    program = subprocess.Popen(command(scenario, out, *more), stdin=subprocess.DEVNULL,
                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    sizes = []
    while program.poll() is None:
        status = pathlib.Path(f"/proc/{program.pid}/status").read_text()
        sizes += [int(line.split()[1]) for line in status.splitlines() if line.startswith("VmRSS")]
        time.sleep(every_s)
    return sizes, json.loads((pathlib.Path(out) / "results.json").read_text())
