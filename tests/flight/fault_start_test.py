"""What keeps a process from starting is one clear line and status 2, for every process of a flight."""

import json
import os
import pathlib
import subprocess
import tempfile
import unittest

FOLDER = pathlib.Path(__file__).parent
ROOT = FOLDER.parents[1]
BIN = pathlib.Path(os.environ["SAKER_BIN"])
SCENARIO = ROOT / "configs/scenarios/small.yaml"
# Starts $FIRST, then, when it is there, the command; its status.
SECOND = '''
eval "$FIRST" & first=$!
sleep 5
status=0; "$@" || status=$?
kill $first; wait $first 2>/dev/null || true
exit $status
'''


def in_namespace(*command, options=(), **variables):
    run = subprocess.run([FOLDER / "in_namespace.sh", *options, *map(str, command)], capture_output=True, text=True,
                         stdin=subprocess.DEVNULL, timeout=60, env={**os.environ, **variables})
    if run.returncode == 77:
        raise unittest.SkipTest(run.stderr)
    return run


class Start(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        holder = tempfile.TemporaryDirectory(prefix="saker_start_")
        cls.addClassCleanup(holder.cleanup)
        cls.folder = pathlib.Path(holder.name)
        for site, port in (("site", 7502), ("other", 7602)):
            in_namespace("timeout", "4", *cls.sim(SCENARIO, cls.folder / site), "--lidar-port", port,
                         "--imu-port", port + 1)

    @staticmethod
    def sim(scenario, out):
        return [BIN / "saker-sim", scenario, "-o", out, "--force"]

    @classmethod
    def flight(cls, site="site", **files):
        files = {"prior": cls.folder / site / "prior.json", "meta": cls.folder / site / "metadata.json", **files}
        return [BIN / "saker-flight", "--prior", files["prior"], "--meta", files["meta"], "-o", cls.folder / "out",
                "--force"]

    @classmethod
    def every(cls):
        return {"saker-sim": cls.sim(SCENARIO, cls.folder / "out"),
                "saker-collision-checker": [BIN / "saker-collision-checker"], "saker-flight": cls.flight()}

    def refused(self, name, run, *words):
        self.assertEqual(run.returncode, 2, run.stderr)
        lines = run.stderr.splitlines()
        self.assertEqual(len(lines), 1, run.stderr)
        self.assertTrue(lines[0].startswith(name + ": "), lines[0])
        for word in words:
            self.assertIn(word, lines[0])

    def test_without_a_multicast_route(self):
        for name, command in self.every().items():
            with self.subTest(name):
                self.refused(name, in_namespace(*command, options=("--without-route",)),
                             "ip route add 239.255.76.67/32 dev lo")

    def test_with_small_socket_buffers(self):
        for name, command in self.every().items():
            with self.subTest(name):
                self.refused(name, in_namespace(*command, "--set", "bus.receive_buffer_kb=1048576"),
                             "sysctl -w net.core.rmem_max=1073741824")

    def test_a_robot_without_a_proper_name(self):
        for name, command in self.every().items():
            with self.subTest(name):
                self.refused(name, in_namespace(*command, "--robot", "my robot"), "robot my robot", "as in R1")

    def test_a_wrong_key(self):
        for name, command in self.every().items():
            with self.subTest(name):
                self.refused(name, in_namespace(*command, "--set", "safety.lidr_s=1"), "lidr_s", "lidar_s")

    def test_a_configuration_that_is_not_there(self):
        for name, command in self.every().items():
            with self.subTest(name):
                self.refused(name, in_namespace(*command, "--config", "/nowhere.yaml"), "/nowhere.yaml")

    def test_a_second_one_of_the_same_robot(self):
        """The second executive has ports of its own: only its name is the same."""
        seconds = {**self.every(), "saker-flight": self.flight("other")}
        for name, command in seconds.items():
            with self.subTest(name):
                first = " ".join(map(str, self.every()[name])).replace(f"{self.folder}/out", f"{self.folder}/first")
                run = in_namespace("bash", "-c", SECOND, "bash", *command, FIRST=f"exec {first} 2>/dev/null")
                self.refused(name, run, f"a second {name} of robot R1 is on the network (process ")

    def test_wrong_scenarios(self):
        good = SCENARIO.read_text()
        wrong = {"unknown.yaml": (good.replace("targets:", "tragets:"), "tragets"),
                 "range.yaml": (good.replace("targets: 3", "targets: -3"), "targets"),
                 "kind.yaml": ("kind: flight\n", "expected mission"),
                 "event.yaml": (good + "  events: [{kind: earthquake}]\n", "earthquake"),
                 "crowded.yaml": (good.replace("targets: 3", "targets: 100"), "targets")}
        for name, (text, word) in wrong.items():
            with self.subTest(name):
                self.assertNotEqual(text, good)
                (self.folder / name).write_text(text)
                self.refused("saker-sim", in_namespace(*self.sim(self.folder / name, self.folder / "out")), word)

    def test_wrong_files_of_the_executive(self):
        (self.folder / "broken.json").write_text("{")
        for files, word in (({"prior": "/nowhere.json"}, "/nowhere.json"), ({"meta": "/nowhere.json"}, "/nowhere.json"),
                            ({"prior": self.folder / "broken.json"}, "broken.json"),
                            ({"meta": self.folder / "broken.json"}, "broken.json")):
            with self.subTest(files):
                self.refused("saker-flight", in_namespace(*self.flight(**files)), word)

    def prior(self, name, places):
        objects = [{"id": i, "class": "vehicle", "probability": 1, "observations": 1, "position": place,
                    "rotation": [0, 0, 0, 1], "size": [4.5, 1.8, 1.5]} for i, place in enumerate(places)]
        (self.folder / name).write_text(json.dumps({"frame": "world", "objects": objects, "ground": []}))
        return self.folder / name

    def test_prior_maps_that_cannot_be(self):
        many = self.prior("many.json", [[10 * i, 0, 0.7] for i in range(10_000)])
        self.refused("saker-flight", in_namespace(*self.flight(prior=many)), "10000 targets", "most_targets")
        for name, place in (("nan.json", [1, float("nan"), 0]), ("inf.json", [1, 1e300, 0]), ("null.json", [1, None, 0])):
            with self.subTest(name):
                self.refused("saker-flight", in_namespace(*self.flight(prior=self.prior(name, [place]))), name)

    def test_a_geofence_that_is_too_large_to_sweep(self):
        empty = self.prior("empty.json", [])
        wide = "motion.geofence.polygon_m=[-9000, -9000, 9000, -9000, 9000, 9000]"
        self.refused("saker-flight", in_namespace(*self.flight(prior=empty), "--set", wide), "most_cells")

    def test_a_port_that_is_taken(self):
        taken = ("import socket,subprocess,sys; s=socket.socket(type=socket.SOCK_DGRAM); s.bind(('',7502)); "
                 "sys.exit(subprocess.call(sys.argv[1:]))")
        self.refused("saker-flight", in_namespace("/usr/bin/python3", "-c", taken, *self.flight()), "7502")


if __name__ == "__main__":
    unittest.main()
