"""No program's instance of an Eigen function stands in for a library's, which allocates in another way."""

import os
import pathlib
import subprocess
import unittest

PROGRAMS = sorted(pathlib.Path(os.environ["SAKER"]).parent.iterdir())


class Exports(unittest.TestCase):
    def test_no_program_exports_eigen(self):
        self.assertIn("saker-flight", [program.name for program in PROGRAMS])
        for program in PROGRAMS:
            with self.subTest(program=program.name):
                run = subprocess.run(["nm", "-D", "--defined-only", program], capture_output=True, text=True, check=True)
                self.assertEqual([line for line in run.stdout.splitlines() if "Eigen" in line], [])


if __name__ == "__main__":
    unittest.main()
