"""Settings are few, each is set by somebody, and each says what it does; the rest is in `saker config --all`."""

import re
import unittest

from program import ROOT, saker

MOST_VALUES, MOST_BYTES = 100, 12_000

# Who sets what: the pilot for a flight or a site, the mounter for an aircraft, the buyer of sensor, computer and radio, the ground
# crew of a team. The longest prefix of a key says it.
WHO = {
    "odometry": "buyer",
    "segmentation": "buyer",
    "slam.measurement_noise": "buyer",
    "uncertainty.model": "buyer",
    "rates": "buyer",
    "mount": "mounter",
    "motion.limits": "mounter",
    "motion.clearance": "mounter",
    "motion.geofence": "pilot",
    "collision_checker.map": "mounter",
    "collision_checker.map.max_nodes": "buyer",
    "active": "pilot",
    "active.view.farthest_m": "buyer",
    "safety": "mounter",
    "safety.land_after_s": "pilot",
    "safety.recover_s": "pilot",
    "safety.battery_return_share": "pilot",
    "safety.battery_land_share": "pilot",
    "mission": "pilot",
    "bus": "ground",
    "bus.receive_buffer_kb": "buyer",
    "sensor": "mounter",
    "exchange": "ground",
    "exchange.link": "buyer",
    "team": "ground",
    "base": "ground",
    "base.most_store_mb": "buyer",
    "mavlink": "mounter",
    "link": "ground",
    "ground": "ground",
    "site.origin": "pilot",
}


def lines_of(text):
    """(key, value or "", comment) of each line with a key; a comment may stand above its key."""
    path, above = [], ""
    for line in text.splitlines():
        bare = line.strip()
        if bare.startswith("#"):
            above = bare[1:].strip()
            continue
        key, rest = re.match(r"(?:- )?(\w+):(.*)", bare).groups()
        depth = (len(line) - len(line.lstrip(" -"))) // 2
        path = path[:depth] + [key]
        value, _, comment = rest.partition("  # ")
        yield ".".join(path), value.strip(), comment or above
        above = ""


def who_sets(key):
    prefixes = [prefix for prefix in WHO if key == prefix or key.startswith(prefix + ".")]
    return WHO[max(prefixes, key=len)] if prefixes else None


class Settings(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.text = saker("config").stdout
        cls.values = [line for line in lines_of(cls.text) if line[1]]

    def test_they_are_few(self):
        self.assertLessEqual(len(self.values), MOST_VALUES)
        self.assertLessEqual(len(self.text.encode()), MOST_BYTES)

    def test_somebody_sets_each(self):
        for key, value, _ in self.values:
            print(f"{who_sets(key) or '?':8} {key}: {value}")
            with self.subTest(key=key):
                self.assertIsNotNone(who_sets(key), "nobody sets it: it is no setting, or WHO lacks it")

    def test_nobody_is_named_for_what_is_no_setting(self):
        keys = [key for key, _, _ in self.values]
        for prefix in WHO:
            with self.subTest(prefix=prefix):
                self.assertTrue(any(key == prefix or key.startswith(prefix + ".") for key in keys))

    def test_each_has_a_meaning_in_a_sentence(self):
        for key, _, comment in self.values:
            with self.subTest(key=key):
                self.assertRegex(comment, r"(^|: )[A-Z].*\.$")

    def test_each_number_has_a_range(self):
        for key, value, comment in self.values:
            if re.fullmatch(r"-?[0-9.e+]+", value):
                with self.subTest(key=key):
                    self.assertIn(" … ", comment)

    def test_all_has_the_settings_as_they_are_and_marks_the_rest(self):
        settings = {key: comment for key, _, comment in lines_of(self.text)}
        marked = []
        for key, _, comment in lines_of(saker("config", "--all").stdout):
            if key in settings:
                self.assertEqual(comment, settings[key])
            elif not any(key.startswith(group + ".") for group in marked):
                self.assertTrue(comment.startswith("~ "), f"{key}: {comment}")
                marked.append(key)
        self.assertGreater(len(marked), 50)

    def test_the_file_in_the_repository_is_what_the_program_prints(self):
        self.assertEqual(self.text, (ROOT / "configs/default.yaml").read_text())


if __name__ == "__main__":
    unittest.main()
