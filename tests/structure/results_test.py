"""docs/results.md is the page of docs/results.json, no older than the code that it speaks of; who quotes from it quotes right."""

import argparse
import contextlib
import importlib.machinery
import importlib.util
import io
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest
import unittest.mock

import repository

sys.path.insert(0, str(repository.ROOT / "scripts"))
from evidence import history, missions, page, quotes, real, real_time  # noqa: E402

DOCS = repository.ROOT / "docs"
FIGURES = DOCS / "results.json"


class Results(unittest.TestCase):
    def setUp(self):
        self.document = json.loads(FIGURES.read_text())

    def test_the_page_is_that_of_the_figures(self):
        self.assertEqual((DOCS / "results.md").read_text(), page.page(self.document), "scripts/results writes it")

    def test_what_is_said_of_real_recordings_is_what_was_measured(self):
        said = real.section(json.loads((DOCS / "real.json").read_text()))
        self.assertEqual(self.document["real"], json.loads(json.dumps(said)), "scripts/results real takes it over")

    def test_figures_are_no_older_than_the_code_they_speak_of(self):
        if why := history.no_history():
            self.skipTest(why)
        self.assertEqual(history.stale(self.document, FIGURES), [])

    def test_the_readme_quotes_what_was_measured(self):
        self.assertEqual(quotes.wrong_quotes((repository.ROOT / "README.md").read_text(), self.document), [])

    def test_the_readme_marks_as_quotations_what_scripts_measured(self):
        lines = (repository.ROOT / "README.md").read_text().split("## Measured")[1].split("\n## ")[0].splitlines()
        rows = [line for line in lines if line.startswith("|") and ("`scripts/results`" in line or "`scripts/real`" in line)]
        self.assertNotEqual(rows, [])
        self.assertEqual([row for row in rows if not quotes.quoted_paths(row)], [])


class Quotes(unittest.TestCase):
    DOCUMENT = {"missions": {"commit": "1a2b3c4", "saker": {"mae_m": 0.02341, "bias_m": -0.0042, "found": 191, "targets": 1192, "share": 0.9947}}}

    def wrong(self, line):
        return quotes.wrong_quotes(line, self.DOCUMENT)

    def test_a_number_is_compared_to_its_own_decimals(self):
        for said in ("0.023 m", "0.0234 m", "0.02 m"):
            self.assertEqual(self.wrong(f"| length | {said} | <!-- results: missions.saker.mae_m -->"), [])
        self.assertEqual(len(self.wrong("| length | 0.024 m | <!-- results: missions.saker.mae_m -->")), 1)

    def test_signs_thousands_and_percent_are_read(self):
        self.assertEqual(self.wrong("−0.004 m <!-- results: missions.saker.bias_m -->"), [])
        self.assertEqual(len(self.wrong("0.004 m <!-- results: missions.saker.bias_m -->")), 1)
        self.assertEqual(self.wrong("1,192 <!-- results: missions.saker.targets -->"), [])
        self.assertEqual(self.wrong("99.5 % <!-- results: missions.saker.share -->"), [])
        self.assertEqual(len(self.wrong("99 % <!-- results: missions.saker.share -->")), 0)
        self.assertEqual(len(self.wrong("98 % <!-- results: missions.saker.share -->")), 1)

    def test_several_paths_are_the_last_numbers_before_the_comment(self):
        line = "6 scenarios: 191 of 1192 found <!-- results: missions.saker.found missions.saker.targets -->, 0.023 m"
        self.assertEqual(self.wrong(line + " <!-- results: missions.saker.mae_m -->"), [])
        self.assertEqual(len(self.wrong(line.replace("191", "192"))), 1)

    def test_a_text_must_be_said(self):
        self.assertEqual(self.wrong("by 1a2b3c4 <!-- results: missions.commit -->"), [])
        self.assertEqual(len(self.wrong("by 1a2b3c5 <!-- results: missions.commit -->")), 1)

    def test_a_path_that_leads_nowhere_and_a_quotation_without_a_number_are_wrong(self):
        self.assertEqual(len(self.wrong("0.023 m <!-- results: missions.saker.mae -->")), 1)
        self.assertEqual(len(self.wrong("few centimetres <!-- results: missions.saker.mae_m -->")), 1)

    def test_what_is_not_marked_is_nobodys_quotation(self):
        self.assertEqual(self.wrong("| length | 17 m | `scripts/results` |"), [])
        self.assertEqual(quotes.quoted_paths("0.02 m <!-- results: a.b c.d -->"), ["a.b", "c.d"])


class History(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory(prefix="saker_results_")
        self.addCleanup(holder.cleanup)
        self.root = pathlib.Path(holder.name)
        self.git("init", "-q")
        self.first = self.commit("results.json", "First")

    def git(self, *command):
        as_somebody = ("-c", "user.name=S", "-c", "user.email=s@example.org")
        return subprocess.run(["git", "-C", self.root, *as_somebody, *command], check=True, capture_output=True, text=True).stdout.strip()

    def commit(self, file, message):
        (self.root / file).write_text(message)
        self.git("add", file)
        self.git("commit", "-q", "-m", message)
        return self.git("rev-parse", "HEAD")

    def stale(self, by=""):
        return history.stale({"missions": {"commit": by[:7]}, "real": {}}, "results.json", self.root)

    def test_nothing_is_old_where_nothing_changed_figures(self):
        self.commit("code.cc", "Another name")
        self.assertEqual(self.stale(self.first), [])

    def test_a_change_of_figures_makes_older_ones_stale_until_they_are_flown_again(self):
        change = self.commit("code.cc", "Another estimator: changes figures")
        self.assertEqual(len(self.stale(self.first)), 2)
        (self.root / "results.json").write_text("flown again")
        self.assertEqual(self.stale(change), [])
        self.commit("results.json", "Figures")
        self.assertEqual(self.stale(change), [])
        self.assertEqual(len(self.stale(self.first)), 1, "a part that was flown before the change")

    def test_a_change_that_comes_with_its_figures_is_not_stale(self):
        (self.root / "code.cc").write_text("other")
        self.git("add", "code.cc")
        self.commit("results.json", "An estimator and its table: changes figures")
        self.assertEqual(self.stale(), [])

    def test_a_clone_without_history_says_so(self):
        self.assertEqual(history.no_history(self.root), "")
        shallow = self.root / "shallow"
        self.commit("code.cc", "Second")
        subprocess.run(["git", "clone", "-q", "--depth", "1", f"file://{self.root}", shallow], check=True)
        self.assertEqual(history.no_history(shallow), "a shallow clone")
        with tempfile.TemporaryDirectory(prefix="saker_no_git_") as bare:
            self.assertEqual(history.no_history(bare), "no git history")


class Parts(unittest.TestCase):
    def test_every_variant_is_a_configuration(self):
        for name, settings in missions.VARIANTS.items():
            words = [part for setting in (*settings.split(), *missions.ALL) for part in ("--set", setting)]
            with self.subTest(variant=name):
                run = subprocess.run([os.environ["SAKER"], "config", *words], capture_output=True, text=True)
                self.assertEqual(run.returncode, 0, run.stderr)

    def test_predictions_are_put_together_by_their_squares(self):
        bins = [{"outcomes": 3, "predicted_m": 0.1, "realised_m": 0.1, "ratio": 1},
                {"outcomes": 1, "predicted_m": 0.1, "realised_m": 0.3, "ratio": 3}]
        said = missions.predicted(bins)
        self.assertAlmostEqual(said.pop("realised_over_predicted"), 3 ** 0.5)
        self.assertEqual(said, {"outcomes": 4, "bins": [1, 3]})

    def test_saker_is_compared_with_each_other_policy_over_all_scenarios(self):
        ratio = {"estimate": 0.5, "low": 0.4, "high": 0.6}
        row = lambda where, who, against: {"scenario": where, "policy": who, "against": against,
                                           "figures": {"mae_m": {"ratio": ratio, "verdict": "less"}, "path_m": {"ratio": ratio, "verdict": "-"}}}
        rows = [row("demo", "saker", "visit"), row("all", "paper", "visit"), row("all", "saker", "visit"), row("all", "saker", "paper")]
        self.assertEqual(missions.compared(rows, "all"), {who: {"mae_m": {**ratio, "verdict": "less"}} for who in ("visit", "paper")})

    def test_of_several_flights_the_median_and_the_worst_are_told(self):
        report = lambda mae, clearance, late: {
            **dict.fromkeys(real_time.FIGURES, 1), "targets": 8, "mae_m": mae, "min_clearance_m": clearance,
            "loops": [{"name": name, "runs": 100, "late": late, "worst_late_ms": 10 * late} for name in real_time.LOOPS]}
        with tempfile.TemporaryDirectory(prefix="saker_flights_") as holder:
            out = pathlib.Path(holder)
            for i, flown in enumerate((report(0.02, 0.5, 0), report(0.05, 0.4, 3), report(0.03, 0.6, 1))):
                (out / f"flight-{i + 1}/report").mkdir(parents=True)
                (out / f"flight-{i + 1}/report/results.json").write_text(json.dumps(flown))
                (out / f"flight-{i + 1}/report/map.png").write_bytes(b"")
            entry = real_time.measure("nowhere", 3, out, out)
        self.assertEqual((entry["median"]["mae_m"], entry["worst"]["mae_m"]), (0.03, 0.05))
        self.assertEqual((entry["median"]["min_clearance_m"], entry["worst"]["min_clearance_m"]), (0.5, 0.4))
        self.assertEqual((entry["median"]["safety_late"], entry["worst"]["safety_late"]), (0.01, 0.03))


def script():
    """scripts/results as a module."""
    loader = importlib.machinery.SourceFileLoader("results_script", str(repository.ROOT / "scripts/results"))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader(loader.name, loader))
    loader.exec_module(module)
    return module


class Seeds(unittest.TestCase):
    """What is flown of teams, by a program that notes the seeds it is asked for."""

    def setUp(self):
        holder = tempfile.TemporaryDirectory(prefix="saker_seeds_")
        self.addCleanup(holder.cleanup)
        self.out = pathlib.Path(holder.name)
        self.script, self.asked, self.programs = script(), [], "as they were"
        self.script.programs_sum = lambda: self.programs
        patch = unittest.mock.patch.object(self.script.missions, "measure_team", self.fly)
        patch.start()
        self.addCleanup(patch.stop)

    def fly(self, _saker, seeds, _threads, _out):
        self.asked.append(seeds)
        return {"found": len(seeds)}

    def measure(self, seed, runs=2, again=False):
        args = argparse.Namespace(out=self.out, docs=self.out, seed=seed, runs=runs, again=again, commit="1a2b3c4", threads=1)
        with contextlib.redirect_stderr(io.StringIO()):
            return self.script.measured("teams", args)

    def test_two_runs_of_two_seeds_are_a_page_of_four(self):
        self.assertEqual(self.measure(351)["seeds"], "351 to 352")
        self.assertEqual(self.measure(353)["seeds"], "351 to 354")
        self.assertEqual(self.asked, [[351, 352], [351, 352, 353, 354]])

    def test_the_same_two_again_keep_the_four(self):
        self.measure(351, runs=4)
        self.assertEqual(self.measure(351)["seeds"], "351 to 354")

    def test_an_interrupted_run_goes_on_with_the_seeds_it_began_with(self):
        self.script.missions.measure_team = unittest.mock.Mock(side_effect=KeyboardInterrupt)
        self.assertRaises(KeyboardInterrupt, self.measure, 351)
        self.script.missions.measure_team = self.fly
        self.assertEqual(self.measure(351)["seeds"], "351 to 352")

    def test_seeds_with_a_gap_and_other_programs_are_refused(self):
        self.measure(351)
        for seed in (354, 350):
            with self.assertRaisesRegex(SystemExit, "expected --seed 353"):
                self.measure(seed)
        self.programs = "others"
        with self.assertRaisesRegex(SystemExit, "begun by other programs .1a2b3c4."):
            self.measure(353)
        self.assertEqual(self.measure(361, again=True)["seeds"], "361 to 362")


if __name__ == "__main__":
    unittest.main()
