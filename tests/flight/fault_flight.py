"""A flight by real processes, over LCM and UDP, that something goes wrong with. Runs in a namespace of its own."""

import csv
import json
import os
import pathlib
import signal
import subprocess
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
BIN = pathlib.Path(os.environ["SAKER_BIN"])
SCENARIO = ROOT / "configs/scenarios/small.yaml"
AT_REST = 0.2  # m/s
FAST = 0.8     # m/s over ground: on the way
# From one side to the other a leg is long enough for a fault in the middle of it.
TWO_SIDES = ("--preset", "visit", "--set", "active.visit.sides=2", "--set", "active.visit.oblique_worth_m=10")


class Row:
    """A line of the simulator's flight_truth.csv."""

    def __init__(self, row):
        self.t = float(row["t_s"])
        vx, vy, vz = (float(row[key]) for key in ("vx_mps", "vy_mps", "vz_mps"))
        self.ground_speed = (vx * vx + vy * vy) ** 0.5
        self.speed = (vx * vx + vy * vy + vz * vz) ** 0.5
        self.landing = row["mode"] in ("land", "descend") or row["armed"] == "0"
        self.armed = row["armed"] == "1"
        self.flying = self.armed and row["mode"] != "idle"
        self.collisions, self.events = int(row["collisions"]), int(row["events"])

    @property
    def calm(self):
        return self.speed < AT_REST or self.landing


class Flight:
    """Simulator, collision checker and executive, with `mavlink` a bridge to that autopilot; `end` them, whatever happens."""

    def __init__(self, folder, event="", settings=(), prior=lambda objects: objects, environment=None, mavlink=""):
        self.folder, self.processes = pathlib.Path(folder), {}
        self.environment = environment or {}  # of the executive, beside this one's
        try:
            self.begin(event, settings, prior, mavlink)
        except BaseException:
            self.end()
            raise

    def begin(self, event, settings, prior, mavlink):
        scenario = self.folder / "scenario.yaml"
        scenario.write_text(SCENARIO.read_text() + (f"  events: [{event}]\n" if event else ""))
        self.site, self.out = self.folder / "simulator", self.folder / "executive"
        behind = ("--mavlink", mavlink, "--mavlink-line", "udp:127.0.0.1:14550") if mavlink else ()
        self.start("saker-sim", scenario, "-o", self.site, *behind)
        self.wait(lambda: (self.site / "metadata.json").exists(), 20, "a site")
        self.choose_targets(prior)
        if mavlink:
            settings = ("mission.command.deadline_s=60", *settings)
            self.start("saker-mavlink", "--set", f"mavlink.autopilot={mavlink}", "--set", "mavlink.line=udp:listen:14550")
        config = ("--config", self.site / "site.yaml")
        self.start("saker-collision-checker", *config)
        own = [word for setting in settings for word in ("--set", setting)]
        self.start("saker-flight", *config, *TWO_SIDES, *own, "--prior", self.site / "prior.json", "--meta",
                   self.site / "metadata.json", "-o", self.out)

    def choose_targets(self, prior):
        file = self.site / "prior.json"
        said = json.loads(file.read_text())
        file.write_text(json.dumps(said | {"objects": prior(said["objects"])}))

    def start(self, name, *arguments):
        more = self.environment if name == "saker-flight" else {}
        with open(self.folder / f"{name}.log", "w") as log:
            self.processes[name] = subprocess.Popen([BIN / name, *map(str, arguments)], stderr=log,
                                                    stdin=subprocess.DEVNULL, env={**os.environ, **more})

    def log(self, name):
        return (self.folder / f"{name}.log").read_text()

    def logs(self):
        return "\n".join(f"{name}:\n" + "\n".join(self.log(name).splitlines()[-15:]) for name in self.processes)

    def wait(self, done, seconds, what):
        end = time.monotonic() + seconds
        while not done():
            if time.monotonic() > end:
                raise AssertionError(f"no {what} within {seconds} s\n{self.logs()}")
            time.sleep(0.02)

    def rows(self):
        """Whole lines only: the simulator is writing."""
        text = (self.site / "flight_truth.csv").read_text()
        return [Row(row) for row in csv.DictReader(text[:text.rfind("\n")].splitlines())]

    def wait_for_row(self, done, seconds, what):
        self.wait(lambda: (rows := self.rows()) and done(rows[-1]), seconds, what)
        return self.rows()[-1]

    def fly_fast(self, seconds=30):
        """Until it is on the way to a target."""
        return self.wait_for_row(lambda row: row.ground_speed > FAST, seconds, "fast flight")

    def fly_into_event(self):
        self.wait_for_row(lambda row: row.events > 0, 30, "event")
        return next(row for row in self.rows() if row.events > 0)

    def kill(self, name):
        self.processes[name].kill()
        self.processes[name].wait()

    def end(self):
        for process in self.processes.values():
            if process.poll() is None:
                process.send_signal(signal.SIGKILL)
            process.wait()
