"""docs/channels.md is what lcmtypes say, and lcmtypes keep to their grammar."""

import re
import subprocess
import sys
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "lcmtypes"))
import channels  # noqa: E402

GOOD = '''package saker;

// About it.
struct good_t {
  const int32_t MOST = 3;

  int64_t utime;      // us, sensor clock, 0..9e15, -
  float height_m;     // m, level, -1e4..1e4, NaN: unknown; a note, with a comma
  string name;        // text, -, 1..20, -
  int32_t num_a;      // count, -, 0..MOST, -
  double a[num_a];    // m, odom, -1..1, -
}
'''


def with_comment(comment):
    return GOOD.replace("m, level, -1e4..1e4, NaN: unknown; a note, with a comma", comment)


class Page(unittest.TestCase):
    def test_is_up_to_date(self):
        self.assertEqual(channels.PAGE.read_text(), channels.page(), "run lcmtypes/channels.py")

    def test_the_code_has_the_same_table(self):
        code = (ROOT / "flight/bus/channels.h").read_text()
        said = re.findall(r'kChannel<(\w+)> = \{"(\w+)",\s+Network::(\w+)\}', code)
        self.assertEqual(sorted(said), sorted((t, s, n) for s, t, n, *_ in channels.channels()))

    def test_the_build_generates_every_message(self):
        listed = (ROOT / "lcmtypes/CMakeLists.txt").read_text()
        names = re.search(r"set\(types ([a-z_\s]+)\)", listed).group(1).split()
        self.assertEqual(sorted(name + "_t" for name in names), sorted(channels.messages()))


class Grammar(unittest.TestCase):
    def test_a_field_is_read_whole(self):
        field = channels.parse(GOOD).fields[1]
        self.assertEqual((field.unit, field.frame, field.range, field.invalid, field.note),
                         ("m", "level", "-1e4..1e4", "NaN: unknown", "a note, with a comma"))

    def test_the_largest_size_counts_texts_and_arrays(self):
        message = channels.parse(GOOD)
        self.assertEqual(channels.largest(message, {}), 8 + 4 + (4 + 20 + 1) + 4 + 3 * 8)

    def test_what_breaks_it_is_refused(self):
        for comment in ("", "metres, level, -1..1, -", "m, moon, -1..1, -", "m, level, -1..MANY, -",
                        "m, level, 1, -", "m, level, -1..1", "m, level, -1..1, NaN", "m, level, -1..1, -, more"):
            with self.subTest(comment=comment), self.assertRaises(channels.Wrong):
                channels.parse(with_comment(comment))

    def test_a_field_without_a_comment_is_refused(self):
        with self.assertRaises(channels.Wrong):
            channels.parse(re.sub(r"height_m; .*", "height_m;", GOOD))

    def test_a_message_without_a_channel_is_refused(self):
        with self.assertRaises(channels.Wrong):
            channels.check({"good_t": channels.parse(GOOD)}, [])

    def test_a_periodic_message_larger_than_a_datagram_is_refused(self):
        known = {"good_t": channels.parse(GOOD.replace("MOST = 3", "MOST = 300"))}
        channels.check(known, [("_GOOD", "good_t", "control", "a", "b", "event")])
        with self.assertRaises(channels.Wrong):
            channels.check(known, [("_GOOD", "good_t", "control", "a", "b", "1 Hz")])


class Generator(unittest.TestCase):
    def test_every_count_of_a_decoder_is_checked(self):
        headers = list((ROOT / "build").glob("*/lcmtypes/cpp/saker/*.hpp"))
        if not headers:
            self.skipTest("nothing was built")
        for header in headers:
            lines = header.read_text().splitlines()
            for before, line in zip(lines, lines[1:]):
                if ".resize(" in line or ".assign(" in line:
                    self.assertRegex(before, r"< [01] \|\| .* > maxlen - pos\) return -1;", f"{header}: {line}")

    def test_lcm_reads_every_file(self):
        for path in sorted((ROOT / "lcmtypes").glob("*.lcm")):
            run = subprocess.run(["lcm-gen", "--debug", str(path)], capture_output=True, text=True)
            self.assertEqual(run.returncode, 0, f"{path}: {run.stderr}")


if __name__ == "__main__":
    unittest.main()
