"""`scripts/faults`: what it leaves, that it goes on, and the missions of CI: none may break an invariant."""

import json
import os
import subprocess
import unittest

from program import ROOT, ProgramTest

SITE = """kind: mission
mission:
  site: {targets: 2}
  capture: {columns: 512, rows: 32}
"""
CI = ("demo", "small", "garage", "wrong_prior", "obstacles")  # with the smallest worlds


class Campaign(ProgramTest):
    def setUp(self):
        super().setUp()
        self.scenario = self.folder / "site.yaml"
        self.scenario.write_text(SITE)
        self.out = self.folder / "out"

    def fly(self, *more, scenarios=None, commit="first", saker=None, timeout=900):
        environment = os.environ | {"FAULTS_COMMIT": commit} | ({"SAKER": str(saker)} if saker else {})
        names = ",".join(map(str, scenarios or [self.scenario]))
        return subprocess.run([ROOT / "scripts/faults", self.out, "--scenarios", names, *map(str, more)], capture_output=True, text=True,
                              env=environment, timeout=timeout, check=False)

    def lines(self):
        return [json.loads(line) for line in (self.out / "missions.jsonl").read_text().splitlines()]

    def test_it_goes_on_where_it_was_and_counts_all(self):
        self.fly("--runs", 1, "--seconds", 10)
        with (self.out / "missions.jsonl").open("a") as file:
            file.write('{"scenario": "si')  # power was lost
        run = self.fly("--runs", 3, "--seconds", 10, commit="second")
        self.assertEqual([(line["seed"], line["commit"]) for line in sorted(self.lines(), key=lambda line: line["seed"])],
                         [(1, "first"), (2, "second"), (3, "second")])
        self.assertIn("flown by first: 1, second: 2", run.stdout)
        drawn = sum(len({kind for kind, _ in line["faults"]}) for line in self.lines())
        rows = run.stdout.split("\n\n")[0].splitlines()[1:]
        self.assertEqual(sum(int(row.split()[1]) for row in rows), drawn)
        self.assertGreater(len(rows), 20, "a row for each kind, drawn or not")
        self.assertEqual(run.returncode, int(any(line["broken"] for line in self.lines())))
        self.assertFalse(list((self.out / "flights").iterdir()))

    def test_a_mission_that_does_not_end_as_it_should_is_broken(self):
        crashes = self.folder / "crashes"
        crashes.write_text("#!/bin/sh\necho killed >&2\nexit 139\n")
        crashes.chmod(0o755)
        run = self.fly("--runs", 1, saker=crashes)
        self.assertEqual(run.returncode, 1)
        self.assertIn("site 1: ends broken: killed", run.stdout)

    def test_what_cannot_be_flown_is_said(self):
        self.scenario.write_text("kind: mission\nmission: {nothing: 1}\n")
        run = self.fly("--runs", 1)
        self.assertEqual(run.returncode, 2)
        self.assertEqual(len(run.stderr.splitlines()), 1, run.stderr)
        self.assertEqual(self.fly("--runs", 0).returncode, 2)
        self.assertEqual(self.fly("--runs", 1, saker=self.folder / "none").returncode, 2)

    def test_twenty_missions_break_nothing(self):
        scenarios = [ROOT / "configs/scenarios" / f"{name}.yaml" for name in CI]
        run = self.fly("--runs", 20, "--seconds", 20, scenarios=scenarios)
        broken = {(line["scenario"], line["seed"], breach["invariant"]) for line in self.lines() for breach in line["broken"]}
        self.assertEqual(broken, set(), run.stdout + run.stderr)
        self.assertEqual(run.returncode, 0)
        self.assertEqual(len(self.lines()), 20)


if __name__ == "__main__":
    unittest.main()
