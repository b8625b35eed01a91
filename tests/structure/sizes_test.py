"""Files of at most 400 lines, functions of at most 60."""

import ast
import unittest

import cpp_functions
import repository

MOST_LINES_OF_A_FILE = 400
MOST_LINES_OF_A_FUNCTION = 60


def python_functions(text):
    kinds = (ast.FunctionDef, ast.AsyncFunctionDef)
    return [(n.lineno, n.end_lineno) for n in ast.walk(ast.parse(text)) if isinstance(n, kinds)]


class Sizes(unittest.TestCase):
    def test_files_are_short(self):
        for path in repository.files(".h", ".cc", ".py"):
            with self.subTest(file=repository.relative(path)):
                self.assertLessEqual(len(path.read_text().splitlines()), MOST_LINES_OF_A_FILE)

    def test_functions_are_short(self):
        for path in repository.files(".h", ".cc", ".py"):
            find = python_functions if path.suffix == ".py" else cpp_functions.functions
            for first, last in find(path.read_text()):
                with self.subTest(function=f"{repository.relative(path)}:{first}"):
                    self.assertLessEqual(last - first + 1, MOST_LINES_OF_A_FUNCTION)


CPP = '''\
#define TWICE(x) \\
  { x; x; }
namespace a {
const int kTable[] = {1, 2};
struct S {
  S(int x) : x_(x) {}  // {
  template <class T = int>
  bool operator==(const T& t) const {
    return t == "}";
  }
};
enum class E { one };
auto f(int a = 3) -> int
{
  if (a) { return R"({)" ? 1'000 : '{'; }
  auto g = [&](int b) { return b; };
  return g(a);
}
}  // namespace a
TEST(A, B) {
  f();
}
'''


class CppFunctions(unittest.TestCase):
    def test_functions_are_found_whatever_is_around_them(self):
        self.assertEqual(cpp_functions.functions(CPP), [(6, 6), (7, 10), (13, 18), (20, 22)])

    def test_lines_are_kept_when_comments_are_taken_out(self):
        self.assertEqual(cpp_functions.functions("/* a\n b { */\nvoid f() {\n  // }\n}\n"), [(3, 5)])


if __name__ == "__main__":
    unittest.main()
