"""How long the documents are, and that what they name is there: links, files, folders."""

import pathlib
import re
import subprocess
import unittest

import repository

MOST_WORDS = 9000
MOST_README_LINES = 70
MOST_FIGURES = 8  # a row each
MOST_LINE = 300
MOST_TERMS = 30
ROOM_LINES = range(5, 16)  # of a module's or process's README, after its title
REFERENCES = {"channels.md", "contract.md"}  # looked up, not read
GENERATED = {"results.md", "real.md", "safety.md"}  # their tables come from results.json, real.json and the tests
ROOTS = ("configs", "docs", "examples", "flight", "lcmtypes", "modules", "scripts", "tests", "tools")
SOURCES = (".h", ".cc", ".py", ".lcm", ".java", ".cmake", ".sed")
LINK = re.compile(r"\]\(([^)\s]+)\)")
IN_BACKTICKS = re.compile(r"`([^`\n]+)`")
FROM_THE_ROOT = re.compile(rf"(?<![\w./$<-])(?:{'|'.join(ROOTS)})/[\w./*<>-]*")


def pages():
    """README and docs/*.md, without those of the notes."""
    return [repository.ROOT / "README.md", *sorted((repository.ROOT / "docs").glob("*.md"))]


def all_pages():
    return [p for p in repository.files(".md") if "notes" not in p.parts]


def present_pages():
    """Those that speak of what is there; the changelog names what went, too."""
    return [p for p in all_pages() if p.name != "CHANGELOG.md"]


def words(page):
    lines = re.sub(r"<!--.*?-->", "", page.read_text()).splitlines()
    if page.name in GENERATED:
        lines = [line for line in lines if not line.startswith("|")]
    return sum(len(line.split()) for line in lines)


def exists(name, *folders):
    """Whether a file or folder of that name lies in one of the folders; `*`, `<module>`, `x.h` and SCENARIO are any name."""
    pattern = re.sub(r"<\w+>|\bSCENARIO\b|\bx(?=\.h$)", "*", name).rstrip("/")
    if "*" in pattern:
        return any(any(folder.glob(pattern)) for folder in folders)
    return any((folder / pattern).exists() for folder in folders)


def is_there(name, page):
    """Whether a source that a page names in backticks exists; without a folder anywhere about the page."""
    root, folder = repository.ROOT, page.parent
    if name.startswith("saker/"):  # a header as others include it
        return exists(name.removeprefix("saker/"), root / "modules")
    if "/" in name:
        return exists(name, root, folder, *(root / r for r in ("modules", "flight", "tools")))
    about = root if folder in (root, root / "docs") else folder
    return any(path.name == name for path in repository.files(name) if about in path.parents)


class Documents(unittest.TestCase):
    def test_they_are_short(self):
        counted = {repository.relative(p): words(p) for p in pages() if p.name not in REFERENCES}
        self.assertLessEqual(sum(counted.values()), MOST_WORDS, counted)

    def test_the_readme_is_a_page(self):
        lines = (repository.ROOT / "README.md").read_text().splitlines()
        self.assertLessEqual(len(lines), MOST_README_LINES)
        measured = lines[lines.index("## Measured") + 1:]
        table = [line for line in measured[:next(
            n for n, line in enumerate(measured) if line.startswith("## "))] if line.startswith("|")]
        self.assertLessEqual(len(table) - 2, MOST_FIGURES)

    def test_a_room_says_what_is_in_it_in_some_lines(self):
        for folder in ("modules", "flight"):
            for page in (repository.ROOT / folder).glob("*/README.md"):
                with self.subTest(page=repository.relative(page)):
                    text = [line for line in page.read_text().splitlines()[1:] if line]
                    self.assertIn(len(text), ROOM_LINES)

    def test_hazards_are_those_of_the_tests(self):
        run = subprocess.run([repository.ROOT / "scripts/evidence/hazards.py", "--check"], capture_output=True, text=True, check=False)
        self.assertEqual(run.returncode, 0, run.stderr)

    def test_terms_are_few(self):
        rows = re.findall(r"^\| .* \|$", (repository.ROOT / "docs/terms.md").read_text(), re.MULTILINE)
        self.assertLessEqual(len(rows) - 1, MOST_TERMS)

    def test_no_line_is_long(self):
        for page in all_pages():
            for number, line in enumerate(page.read_text().splitlines(), 1):
                with self.subTest(line=f"{repository.relative(page)}:{number}"):
                    self.assertLessEqual(len(line), MOST_LINE)

    def test_links_lead_to_files(self):
        for page in all_pages():
            for link in LINK.findall(page.read_text()):
                target = link.split("#")[0]
                if target and not re.match(r"[a-z]+:", target):
                    with self.subTest(page=repository.relative(page), link=link):
                        self.assertTrue((page.parent / target).exists())

    def test_links_lead_to_headings(self):
        for page in all_pages():
            for link in LINK.findall(page.read_text()):
                target, _, heading = link.partition("#")
                other = page.parent / target if target else page
                if heading and other.suffix == ".md" and not re.match(r"[a-z]+:", target):
                    titles = re.findall(r"^#+ (.*)$", other.read_text(), re.MULTILINE)
                    anchors = {re.sub(r"[^\w -]", "", t.lower()).replace(" ", "-") for t in titles}
                    with self.subTest(page=repository.relative(page), link=link):
                        self.assertIn(heading, anchors)

    def test_paths_from_the_root_exist(self):
        for page in present_pages():
            for path in FROM_THE_ROOT.findall(page.read_text()):
                with self.subTest(page=repository.relative(page), path=path):
                    self.assertTrue(exists(path.rstrip("."), repository.ROOT))

    def test_sources_in_backticks_exist(self):
        for page in present_pages():
            for span in IN_BACKTICKS.findall(page.read_text()):
                name = span.split(":")[0]
                if re.fullmatch(r"[\w./<>-]+", name) and name.endswith(SOURCES):
                    with self.subTest(page=repository.relative(page), source=name):
                        self.assertTrue(is_there(name, page))


if __name__ == "__main__":
    unittest.main()
