"""Figures that a page quotes from docs/results.json.

A comment names what the numbers before it on its line are, back to the line's start or the comment before:
    | length and width (MAE) | 0.023 m | <!-- results: missions.saker.mae_m -->
    found 96 of 96 <!-- results: missions.saker.found missions.saker.targets --> by 1a2b3c4 <!-- results: missions.commit -->
Of k paths the last k numbers count; a number is compared to its own decimals, one before "%" as a hundredth; a path that leads to a
text, as a commit or a date, wants that text.
"""
import re

MARK = re.compile(r"<!-- results: ([^>]*?) *-->")
NUMBER = re.compile(r"([−-]?\d[\d,]*(?:\.\d+)?)( ?%)?")


def at(document, path):
    """None where the path leads nowhere."""
    for key in path.split("."):
        if isinstance(document, list) and key.isdigit() and int(key) < len(document):
            document = document[int(key)]
        elif isinstance(document, dict) and key in document:
            document = document[key]
        else:
            return None
    return document


def same(number, percent, value):
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        return False
    number = number.replace("−", "-").replace(",", "")
    decimals = len(number.partition(".")[2])
    return float(number) == round(value * (100 if percent else 1), decimals)


def wrong_in_line(line, document):
    start = 0
    for mark in MARK.finditer(line):
        said, start = line[start:mark.start()], mark.end()
        paths = mark.group(1).split()
        values = [at(document, path) for path in paths]
        for path, value in zip(paths, values):
            if isinstance(value, str) and value not in said:
                yield f"{path} is {value}, not said in \"{said.strip()}\""
        figures = [(path, value) for path, value in zip(paths, values) if not isinstance(value, str)]
        numbers = NUMBER.findall(said)[len(NUMBER.findall(said)) - len(figures):] if figures else []
        if len(numbers) < len(figures):
            yield f"{mark.group(1)}: fewer numbers than paths in \"{said.strip()}\""
        for (path, value), (number, percent) in zip(figures, numbers):
            if not same(number, bool(percent), value):
                yield f"{path} is {value}, quoted as {number}"


def wrong_quotes(page, document):
    """A line for each quotation that is not what the document says."""
    return [wrong for line in page.splitlines() for wrong in wrong_in_line(line, document)]


def quoted_paths(page):
    return [path for mark in MARK.findall(page) for path in mark.split()]
