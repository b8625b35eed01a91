"""What keeps the house readable, as figures: depth of inheritance, comments in headers, tests for the product."""

import re
import unittest

import cpp_functions
import repository

MOST_BASES_IN_A_CHAIN = 2
LEAST_COMMENTS = 0.15  # of the lines of headers that are not blank
LEAST_TESTS = 0.65  # lines of tests for a line of product
LEAST_TESTS_OF_A_MODULE = 0.6

CLASS = re.compile(r"(?<!enum )\b(?:class|struct)\s+(?:\[\[\w+\]\]\s*)?(\w+)(?:\s+final)?\s*:(?!:)([^{;]*)\{")


def bases_of(text):
    """{class: [its bases]} of a source, by their names without namespaces and arguments of templates."""
    found = {}
    for name, bases in CLASS.findall(cpp_functions.without_groups(cpp_functions.blank_out(text))):
        words = [re.sub(r"\b(public|protected|private|virtual)\b", "", base) for base in bases.split(",")]
        found[name] = [word.strip().split("::")[-1] for word in words]
    return found


def chain(name, bases):
    """The longest way from a class up to one without a base: names, the class itself first."""
    ways = [chain(base, bases) for base in bases.get(name, []) if base != name]
    return [name] + max(ways, key=len, default=[])


def comment_lines(text):
    """(lines that hold a comment and no code, lines that are not blank), as cloc counts them."""
    lines = [line.strip() for line in text.splitlines() if line.strip()]
    return sum(line.startswith("//") for line in lines), len(lines)


def lines(folder, *suffixes):
    """{file below the folder: its lines, without those that are blank}."""
    return {path: sum(1 for line in path.read_text().splitlines() if line.strip())
            for path in repository.files(*suffixes) if repository.relative(path).startswith(folder + "/")}


class Inheritance(unittest.TestCase):
    def test_no_class_has_more_than_two_bases_above_it(self):
        bases = {}
        for path in repository.files(".h", ".cc"):
            bases.update(bases_of(path.read_text()))
        self.assertGreater(len(bases), 20)  # the reader still reads
        for name in bases:
            with self.subTest(name=name):
                self.assertLessEqual(len(chain(name, bases)) - 1, MOST_BASES_IN_A_CHAIN, " : ".join(chain(name, bases)))


class Comments(unittest.TestCase):
    def test_headers_say_what_they_hold(self):
        """Of all headers of the product together; each one is not asked: a header of three declarations needs none."""
        commented = total = 0
        for path in repository.files(".h"):
            if not repository.relative(path).startswith("tests/"):
                comments, all_lines = comment_lines(path.read_text())
                commented, total = commented + comments, total + all_lines
        self.assertGreaterEqual(commented / total, LEAST_COMMENTS)


class Tests(unittest.TestCase):
    """Lines are those that are not blank of .h, .cc and .py files: of modules, flight and tools against all of tests but the
    benchmarks and the tests of the structure; a module's are those of modules/NAME against tests/NAME. What tests/system and
    other modules' tests do for a module is not counted for it."""

    SUFFIXES = (".h", ".cc", ".py")

    def test_the_product_is_tested(self):
        product = sum(sum(lines(folder, *self.SUFFIXES).values()) for folder in ("modules", "flight", "tools"))
        tests = sum(count for path, count in lines("tests", *self.SUFFIXES).items()
                    if not repository.relative(path).startswith(("tests/benchmarks/", "tests/structure/")))
        self.assertGreaterEqual(tests / product, LEAST_TESTS, f"{tests} lines of tests, {product} of the product")

    def test_every_module_is_tested(self):
        for module in repository.modules():
            product = sum(lines(f"modules/{module}", *self.SUFFIXES).values())
            tests = sum(lines(f"tests/{module}", *self.SUFFIXES).values())
            with self.subTest(module=module):
                self.assertGreaterEqual(round(tests / product, 3), LEAST_TESTS_OF_A_MODULE,
                                        f"{tests} lines of tests, {product} of the product")


SOURCE = '''\
namespace a {
class Base { };
class Plain;  // : public Wrong {
struct Middle final : public b::Base, private std::vector<std::pair<int, int>> {
  explicit Middle(int a) : a_(a) {}
};
template <class T>
class Last
    : public Middle<T> {
};
enum class Kind : int { one };
}
'''


class Reader(unittest.TestCase):
    def test_bases_are_found_whatever_is_around_them(self):
        self.assertEqual(bases_of(SOURCE), {"Middle": ["Base", "vector"], "Last": ["Middle"]})

    def test_a_chain_is_as_long_as_its_longest_way(self):
        self.assertEqual(chain("Last", bases_of(SOURCE)), ["Last", "Middle", "Base"])

    def test_comments_are_counted_by_the_line(self):
        self.assertEqual(comment_lines("// one\n  /// two\nint a;  ///< counts as code\n\n"), (2, 3))


if __name__ == "__main__":
    unittest.main()
