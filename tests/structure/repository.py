"""The repository's files, as the tests of its structure see them."""

import os
import pathlib
import re

ROOT = pathlib.Path(__file__).resolve().parents[2]
USES = r"^saker_uses\((\w+)([^)]*)\)"
LEFT_OUT = {"build", ".git", "__pycache__"}


def files(*suffixes):
    """All files under the root with one of these endings, sorted; build folders are left out."""
    found = []
    for folder, folders, names in os.walk(ROOT):
        folders[:] = [f for f in folders if f not in LEFT_OUT]
        found += [pathlib.Path(folder) / n for n in names if n.endswith(suffixes)]
    return sorted(found)


def relative(path):
    return str(path.relative_to(ROOT))


def modules():
    """Names of the modules in the order of modules/CMakeLists.txt."""
    text = (ROOT / "modules/CMakeLists.txt").read_text()
    return [name for name, _ in re.findall(USES, text, re.MULTILINE)]


def uses():
    """{module: those that it uses}, as modules/CMakeLists.txt has them."""
    text = (ROOT / "modules/CMakeLists.txt").read_text()
    return {name: set(others.split()) for name, others in re.findall(USES, text, re.MULTILINE)}


def includes(path):
    """The quoted includes of a source."""
    return re.findall(r'^\s*#\s*include\s+"([^"]+)"', path.read_text(), re.MULTILINE)
