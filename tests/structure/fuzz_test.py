"""Every fuzz target is built, has seeds, and says which sources it reads with; what is run under sanitisers is there."""

import re
import unittest

import repository

FUZZ = repository.ROOT / "tests/fuzz"


def targets():
    return sorted(path.name.removesuffix("_fuzz.cc") for path in FUZZ.glob("*_fuzz.cc"))


class Fuzz(unittest.TestCase):
    def test_each_target_names_the_sources_of_its_reader(self):
        rows = [line.split() for line in (FUZZ / "readers.txt").read_text().splitlines() if not line.startswith("#")]
        self.assertEqual(sorted(row[0] for row in rows), targets())
        for row in rows:
            self.assertGreater(len(row), 1, row)
            for source in row[1:]:
                self.assertTrue((repository.ROOT / source).is_file(), source)

    def test_each_target_is_built(self):
        text = (FUZZ / "CMakeLists.txt").read_text()
        for target in targets():
            self.assertRegex(text, rf"\b{target}\b")

    def test_each_target_has_seeds(self):
        text = "".join((FUZZ / name).read_text() for name in ("seeds.cc", "flight_seeds.cc"))
        seeded = set(re.findall(r'(?:add|file)\("(\w+)"', text))
        self.assertEqual(sorted(seeded), targets())


class Sanitisers(unittest.TestCase):
    def test_each_part_is_a_program_of_tests(self):
        text = (repository.ROOT / "scripts/test").read_text()
        parts = {part for names in re.findall(r"^(?:bytes|flight)=\((.*)\)$", text, re.MULTILINE) for part in names.split()}
        made = "".join(path.read_text() for path in repository.files("CMakeLists.txt"))
        self.assertGreater(len(parts), 5)
        for part in parts:
            self.assertRegex(made, rf"saker_test\({part}\b")


if __name__ == "__main__":
    unittest.main()
