"""Saker's sources in the build of another project: `add_subdirectory` with the smallest module."""

import json
import pathlib
import subprocess
import tempfile
import unittest

from program import ROOT

PROJECT = """cmake_minimum_required(VERSION 3.25)
project(theirs LANGUAGES CXX)
set(SAKER_MODULES ${MODULES})
add_subdirectory(${SAKER} saker)
add_executable(theirs main.cc)
target_link_libraries(theirs PRIVATE saker::core)
file(WRITE ${CMAKE_BINARY_DIR}/data.txt "${saker_DATA_DIR}")
"""
# A parameter that is not used and a narrowing: warnings of ours, not of theirs.
PROGRAM = """#include <cstdio>
#include "saker/core/se3.h"
int main(int count, char**) {
  const float quarter = 1.5707963267948966;
  std::printf("%.3f", saker::core::yaw(saker::core::so3_exp({0, 0, quarter})));
  return count - 1;
}
"""


def run(*words):
    return subprocess.run([str(word) for word in words], stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=900)


class Subdirectory(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        holder = tempfile.TemporaryDirectory(prefix="saker_subdirectory_")
        cls.addClassCleanup(holder.cleanup)
        cls.folder = pathlib.Path(holder.name)
        (cls.folder / "CMakeLists.txt").write_text(PROJECT)
        (cls.folder / "main.cc").write_text(PROGRAM)
        cls.build = cls.folder / "build"
        configured = cls.configure("core", cls.build)
        assert configured.returncode == 0, configured.stderr

    @classmethod
    def configure(cls, modules, build):
        return run("cmake", "-S", cls.folder, "-B", build, "-G", "Ninja", f"-DSAKER={ROOT}", f"-DMODULES={modules}",
                   "-DCMAKE_EXPORT_COMPILE_COMMANDS=ON")

    def test_only_the_module_that_was_asked_for_is_built(self):
        targets = run("ninja", "-C", self.build, "-t", "targets", "all").stdout
        made = {line.split(":")[0] for line in targets.splitlines() if "_LINKER__" in line}
        self.assertEqual({pathlib.Path(name).name for name in made}, {"libsaker_core.a", "theirs"})

    def test_their_sources_get_the_instruction_set_and_none_of_our_warnings(self):
        commands = json.loads((self.build / "compile_commands.json").read_text())
        own = next(entry["command"] for entry in commands if entry["file"].endswith("main.cc"))
        self.assertIn("-march=", own)
        self.assertIn("-DEIGEN_MAX_ALIGN_BYTES=16", own)
        self.assertNotIn("-Wconversion", own)
        self.assertNotIn("-Werror", own)

    def test_models_are_found_where_an_installed_saker_says_them(self):
        self.assertTrue((pathlib.Path((self.build / "data.txt").read_text()) / "models/classes.yaml").is_file())

    def test_a_module_that_is_none_is_named(self):
        failed = self.configure("odometer", self.folder / "wrong")
        self.assertNotEqual(failed.returncode, 0)
        self.assertIn("no module odometer", failed.stderr)

    def test_their_program_uses_it(self):
        built = run("cmake", "--build", self.build)
        self.assertEqual(built.returncode, 0, built.stdout[-3000:])
        self.assertEqual(run(self.build / "theirs").stdout, "1.571")


if __name__ == "__main__":
    unittest.main()
