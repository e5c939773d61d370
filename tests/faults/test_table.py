"""Every row of docs/faults.md has a test that carries its number, or a sentence why not."""

import ast
import functools
import re
from pathlib import Path

TESTS = Path(__file__).resolve().parents[1]
DOCUMENT = TESTS.parent / "docs" / "faults.md"
COUNTS = {"A": 16, "B": 13, "C": 7, "D": 11, "E": 13, "F": 8, "G": 15, "H": 7}


def rows() -> dict[str, str]:
    """Row -> what happens."""
    return dict(re.findall(r"^\| ([A-H]\d+) \| .* \| (.*) \|$", DOCUMENT.read_text(), re.MULTILINE))


@functools.cache
def proven() -> set[str]:
    """The rows that tests name, by a marker or at the beginning of their own name."""
    found = set()
    for text in (path.read_text() for path in TESTS.rglob("test_*.py")):
        for node in ast.walk(ast.parse(text)) if re.search(r"mark\.fault\(|def test_[a-h]\d", text) else ():
            if isinstance(node, ast.FunctionDef) and (named := re.match(r"test_([a-h]\d+)_", node.name)):
                found.add(named[1].upper())
            if isinstance(node, ast.Call) and ast.unparse(node.func) == "pytest.mark.fault":
                found |= {str(ast.literal_eval(argument)) for argument in node.args}
    return found


def test_the_table_has_every_row():
    assert list(rows()) == [f"{part}{number}" for part, count in COUNTS.items() for number in range(1, count + 1)]


def test_each_row_has_a_test_or_a_sentence_why_not():
    open_rows = {row for row, text in rows().items() if not text.startswith("Not here: ")}
    assert open_rows - proven() == set()


def test_no_test_names_a_row_that_is_not_there():
    assert proven() - set(rows()) == set()
