"""Arrows between modules go down only: the table of the layers against includes, CMake and README."""

import re
import unittest

import repository

# Module: layer, and what it may use. `autonomy` may use all but the simulation.
LAYERS = {
    "core": (0, ""),
    "lidar": (1, "core"),
    "objects": (1, "core"),
    "occupancy": (1, "core"),
    "odometry": (2, "core lidar"),
    "segmentation": (2, "core lidar objects"),
    "detection": (2, "core lidar objects"),
    "slam": (2, "core objects"),
    "uncertainty": (2, "core objects"),
    "motion": (2, "core occupancy"),
    "simulation": (2, "core lidar objects"),
    "active": (3, "core objects uncertainty occupancy motion"),
    "multirobot": (3, "core objects slam"),
    "exchange": (3, "core objects slam"),
    "autonomy": (4, "core lidar objects occupancy odometry segmentation detection slam uncertainty "
                    "motion active multirobot exchange"),
}
OUTSIDE = ("lcm/", "sys/socket.h", "netinet/", "arpa/", "opencv2/highgui")  # of layer 5 only
THE_SENSORS_SOCKET = "modules/lidar/udp_receiver.cc"  # the one edge that lies in a module


def used(module):
    """{included module: one of the sources that include it}; what the build generates (*.inc) belongs to no module."""
    found = {}
    for path in repository.files(".h", ".cc"):
        name = repository.relative(path)
        if not name.startswith(f"modules/{module}/"):
            continue
        for include in repository.includes(path):
            if include.endswith(".inc"):
                continue
            folder, *rest = include.split("/")
            found.setdefault(rest[0] if folder == "saker" else include, name)
    return found


class Layers(unittest.TestCase):
    def test_includes_go_down_only(self):
        for module in repository.modules():
            allowed = set(LAYERS[module][1].split()) | {module}
            for other, source in used(module).items():
                with self.subTest(source=source, includes=other):
                    self.assertIn(other, allowed)

    def test_cmake_names_every_module_that_is_included(self):
        linked = repository.uses()
        for module in repository.modules():
            for other, source in used(module).items():
                if other != module:
                    with self.subTest(source=source, includes=other):
                        self.assertIn(other, linked[module])

    def test_cmake_and_the_table_name_the_same(self):
        self.assertEqual(repository.uses(), {module: set(uses.split()) for module, (_, uses) in LAYERS.items()})

    def test_the_processes_do_not_use_the_tools(self):
        for path in repository.files(".h", ".cc"):
            if repository.relative(path).startswith("flight/"):
                with self.subTest(source=repository.relative(path)):
                    self.assertEqual([i for i in repository.includes(path) if i.startswith("tools/")], [])

    def test_the_table_itself_goes_down_only(self):
        for module, (layer, uses) in LAYERS.items():
            for other in uses.split():
                self.assertLess(LAYERS[other][0], layer, f"{module} uses {other}")

    def test_modules_are_listed_in_an_order_in_which_each_comes_after_what_it_uses(self):
        order = repository.modules()
        for module in order:
            for other in used(module):
                if other in order:
                    self.assertLessEqual(order.index(other), order.index(module), f"{module} uses {other}")

    def test_every_folder_is_a_listed_module(self):
        folders = {p.parent.name for p in (repository.ROOT / "modules").glob("*/CMakeLists.txt")}
        self.assertEqual(folders, set(repository.modules()))

    def test_every_module_has_a_readme(self):
        for module in repository.modules():
            with self.subTest(module=module):
                self.assertTrue((repository.ROOT / "modules" / module / "README.md").is_file())

    def test_the_readme_shows_the_modules_in_the_same_order(self):
        readme = (repository.ROOT / "README.md").read_text()
        diagram = re.search(r"## Modules\n.*?```\n(.*?)```", readme, re.DOTALL).group(1)
        shown = re.findall(r"^ *([a-z_]+) ", diagram, re.MULTILINE)
        self.assertEqual(shown, repository.modules())

    def test_middleware_and_sockets_stay_out_of_the_modules(self):
        for path in repository.files(".h", ".cc"):
            name = repository.relative(path)
            if not name.startswith("modules/") or name == THE_SENSORS_SOCKET:
                continue
            for include in re.findall(r"#\s*include\s+[<\"]([^>\"]+)", path.read_text()):
                with self.subTest(source=repository.relative(path)):
                    self.assertFalse(include.startswith(OUTSIDE), include)


if __name__ == "__main__":
    unittest.main()
