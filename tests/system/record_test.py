"""`--record`: scans of a run in an MCAP file, which `saker replay` reads again."""

import json
import math
import os
import pathlib
import shutil
import struct
import subprocess
import unittest
import xml.etree.ElementTree

from program import ProgramTest, saker

FLIGHT = """kind: flight
flight:
  duration_s: 2
  speed_mps: 1.0
  height_m: 3.4
  capture: {rows: 64, columns: 512}
"""
PLACE_M = 0.05  # of the last pose: the recording holds no inertial samples


ROOT = pathlib.Path(__file__).resolve().parents[2]
PEER, PACKAGES = ROOT / "tests/peers/read_mcap.cjs", ROOT / "build/npm/peers/node_modules"


class Cdr:
    """Little-endian CDR, from behind its four bytes of encapsulation."""

    def __init__(self, data):
        self.data, self.at = data[4:], 0

    def number(self, kind):
        size = struct.calcsize(kind)
        self.at += -self.at % size
        self.at += size
        return struct.unpack_from("<" + kind, self.data, self.at - size)[0]

    def bytes(self):
        size = self.number("I")
        self.at += size
        return self.data[self.at - size:self.at]

    def text(self):
        return self.bytes().rstrip(b"\0").decode()


def cloud_of(data):
    """(stamp s, {field: (offset, type)}, step, points as bytes) of a sensor_msgs/PointCloud2."""
    cdr = Cdr(data)
    stamp = cdr.number("i") + 1e-9 * cdr.number("I")
    cdr.text()
    height, width = cdr.number("I"), cdr.number("I")
    fields = {}
    for _ in range(cdr.number("I")):
        name = cdr.text()
        fields[name] = (cdr.number("I"), cdr.number("B"))
        cdr.number("I")
    assert cdr.number("B") == 0, "big-endian"
    step, row = cdr.number("I"), cdr.number("I")
    points = cdr.bytes()
    assert row == width * step and len(points) == height * row
    return stamp, fields, step, points


def last_place(out):
    return [float(word) for word in (out / "trajectory.txt").read_text().splitlines()[-1].split()[1:4]]


class Record(ProgramTest):
    def setUp(self):
        super().setUp()
        scenario, made = self.folder / "flight.yaml", self.folder / "made"
        scenario.write_text(FLIGHT)
        run = saker("simulate-scans", scenario, "-o", made, "--seed", 5)
        self.assertEqual(run.returncode, 0, run.stderr)
        (self.capture,) = made.rglob("*.pcap")

    def test_a_recorded_replay_is_replayed_with_all_its_scans(self):
        first, second, file = self.folder / "first", self.folder / "second", self.folder / "run.mcap"
        run = saker("replay", self.capture, "-o", first, "--record", file)
        self.assertLessEqual(run.returncode, 1, run.stderr)
        self.assertIn("report.html", run.stderr.splitlines()[-1])
        again = saker("replay", file, "-o", second)
        self.assertLessEqual(again.returncode, 1, again.stderr)
        scans = [json.loads((out / "results.json").read_text())["scans"] for out in (first, second)]
        self.assertGreater(scans[0], 10)
        self.assertEqual(*scans)
        self.assertLess(math.dist(last_place(first), last_place(second)), PLACE_M)
        page = xml.etree.ElementTree.parse(first / "report.html").getroot()
        self.assertTrue(page.tag.endswith("html"))
        self.assertTrue(any(node.tag.endswith("svg") for node in page.iter()))
        self.assertIn("is there", self.refused("replay", self.capture, "-o", self.folder / "third", "--record", file))

    def test_an_independent_reader_finds_the_same_scans(self):
        """npm's @mcap/core, and the message's layout as ROS has it."""
        node = shutil.which("node")
        if not node or not PACKAGES.exists():
            self.skipTest("no npm packages of others: scripts/setup --peers installs them")
        out, file, said = self.folder / "out", self.folder / "run.mcap", self.folder / "messages"
        self.assertLessEqual(saker("replay", self.capture, "-o", out, "--record", file).returncode, 1)
        subprocess.run([node, PEER, file, said], check=True, env=os.environ | {"NODE_PATH": str(PACKAGES)})
        data, at, clouds = said.read_bytes(), 0, []
        while at < len(data):
            parts = []
            for head in ("<I", "<I", "<qI"):
                *_, size = struct.unpack_from(head, data, at)
                at += struct.calcsize(head) + size
                parts.append(data[at - size:at])
            if parts[1] == b"sensor_msgs/PointCloud2":
                clouds.append(cloud_of(parts[2]))
        self.assertEqual(len(clouds), json.loads((out / "results.json").read_text())["scans"])
        self.assertEqual([stamp for stamp, *_ in clouds], sorted(stamp for stamp, *_ in clouds))
        for _, fields, step, points in clouds:
            self.assertEqual([fields[name][1] for name in ("x", "y", "z", "t")], [7, 7, 7, 6])  # float32 and uint32
            self.assertGreater(len(points) // step, 10_000)
            for place in range(0, len(points), 97 * step):
                x, y, z = (struct.unpack_from("<f", points, place + fields[name][0])[0] for name in "xyz")
                self.assertTrue(0.3 < math.hypot(x, y, z) < 200)
                self.assertLess(struct.unpack_from("<I", points, place + fields["t"][0])[0], 100_000_000)


if __name__ == "__main__":
    unittest.main()
