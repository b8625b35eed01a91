"""Finds the functions of a C++ source by its braces: no compiler, good enough to measure lengths."""

import re

NOT_CODE = re.compile(
    r'R"(?P<mark>[^(\s]*)\(.*?\)(?P=mark)"'  # raw strings
    r'|"(?:\\.|[^"\\\n])*"|//[^\n]*|/\*.*?\*/'
    r"|(?<![0-9a-fA-F])'(?:\\.|[^'\\\n])+'"  # characters, but not 1'000
    r"|^[ \t]*#(?:[^\n]*\\\n)*[^\n]*",
    re.DOTALL | re.MULTILINE)
SCOPE = re.compile(r"\b(namespace|class|struct|union|enum|extern)\b")


def blank_out(text):
    """The text without strings, comments and directives, lines kept."""
    return NOT_CODE.sub(lambda match: "\n" * match.group().count("\n"), text)


def without_groups(text):
    """`void f(int a = 1)` -> `void f()`, `template <class T = int>` -> `template `."""
    previous = None
    while previous != text:
        previous = text
        text = re.sub(r"\([^()]+\)", "()", text)
        text = re.sub(r"<[^<>()]*>", "", text)
    return text


def opens_function(head):
    """Whether a block after `head`, at the scope of a namespace or class, is a function's body."""
    bare = without_groups(head)
    if "(" not in bare or ("=" in bare and "operator" not in bare):
        return False
    return not SCOPE.search(bare.split("(")[0])


def functions(text):
    """[(first line, last line)] of every function, its head included, counted from 1."""
    code = blank_out(text)
    found, start, depth_of_body, depth = [], 0, None, 0
    head_begin = 0
    for at, character in enumerate(code):
        if character == "{":
            if depth_of_body is None and opens_function(code[head_begin:at]):
                depth_of_body, start = depth, head_begin
            depth += 1
        elif character == "}":
            depth -= 1
            if depth_of_body is not None and depth == depth_of_body:
                found.append((line_of(code, first_visible(code, start)), line_of(code, at)))
                depth_of_body = None
        if character in "{};":
            head_begin = at + 1
    return found


def first_visible(code, at):
    while at < len(code) and code[at].isspace():
        at += 1
    return at


def line_of(code, at):
    return code.count("\n", 0, at) + 1
