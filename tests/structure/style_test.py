"""How the sources look: formatting, guards, and nothing that belongs to one machine."""

import os
import re
import shutil
import subprocess
import unittest

import repository

TEXTS = (".h", ".cc", ".py", ".md", ".txt", ".yaml", ".json", ".cmake", ".lcm")
FOLDERS_OF_A_MACHINE = re.compile(r"(?<![\w.$}/-])/(?:home|root|work|Users|mnt)[/\w-]*/")


def scripts():
    return [p for folder in ("scripts", ".ci") for p in sorted((repository.ROOT / folder).iterdir())
            if p.is_file()]


class Style(unittest.TestCase):
    def test_sources_are_formatted(self):
        formatter = shutil.which("clang-format")
        self.assertIsNotNone(formatter, "scripts/setup installs clang-format")
        sources = [str(p) for p in repository.files(".h", ".cc")]
        run = subprocess.run([formatter, "--dry-run", "-Werror", *sources], cwd=repository.ROOT,
                             capture_output=True, text=True)
        wrong = sorted(set(re.findall(r"^([^:\n]+):\d+:\d+: error", run.stderr, re.MULTILINE)))
        self.assertEqual(wrong, [], "scripts/format formats them")
        self.assertEqual(run.returncode, 0, run.stderr)

    def test_headers_are_guarded(self):
        for path in repository.files(".h"):
            with self.subTest(header=repository.relative(path)):
                self.assertIn("#pragma once\n", path.read_text())

    def test_libraries_do_not_print(self):
        for path in repository.files(".h", ".cc"):
            if repository.relative(path).startswith("modules/"):
                with self.subTest(source=repository.relative(path)):
                    self.assertNotRegex(path.read_text(), r"std::c(out|err)\b|\bprintf\(")

    def test_no_path_of_one_machine(self):
        for path in repository.files(*TEXTS) + scripts():
            with self.subTest(file=repository.relative(path)):
                self.assertEqual(FOLDERS_OF_A_MACHINE.findall(path.read_text()), [])

    def test_scripts_can_be_run(self):
        for path in scripts():
            with self.subTest(script=repository.relative(path)):
                self.assertTrue(os.access(path, os.X_OK))
                lines = path.read_text().splitlines()
                self.assertTrue(lines[0].endswith("python3") or "set -euo pipefail" in lines)


if __name__ == "__main__":
    unittest.main()
