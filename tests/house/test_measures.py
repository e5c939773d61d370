"""The measures count what they say, on a small package."""

from pathlib import Path

import pytest
from tests.house.closures import closure, folder_circles
from tests.house.measures import SHAPE, UNIT, commented, doubled_classes, wide_calls
from tests.house.source import circles, imports, modules

CALLS = '''"""Module."""
from small.b import Box


class Box:
    """One line."""


def narrow(values):
    # A comment of its own.
    return max(1, 2, 3, 4, 5, 6, 7, 8, 9) + f(1, 2, 3, 4, 5, 6, 7, *values) + f(1, x=2)
'''
CIRCLE = "class Box: ...\ndef use():\n    from small.a import narrow\n"


@pytest.fixture
def small(tmp_path: Path) -> Path:
    folder = tmp_path / "small"
    folder.mkdir()
    (folder / "__init__.py").write_text("")
    (folder / "a.py").write_text(CALLS)
    (folder / "b.py").write_text(CIRCLE)
    return folder


def test_a_circle_is_found_through_an_import_inside_a_function(small):
    found = modules(small)
    assert circles(imports(found, "small")) == [["a", "b"]]


def test_calls_lines_and_doubled_classes_are_counted(small):
    found = list(modules(small).values())
    assert wide_calls(found) == ["a:11"]
    assert doubled_classes(found) == ["Box"]
    by_name = modules(small)
    assert by_name["a"].code_lines() == 4
    assert by_name["a"].comment_lines() == {10}
    assert commented(found) == "none"


@pytest.mark.parametrize("text", ["[m]", "[N/m^1.5]", "[N s/m]", "[m/s^2]", "[kg m^2]", "[1/m]", "[Pa]", "[%]"])
def test_units_are_told_from_shapes(text):
    assert UNIT.search(text)


@pytest.mark.parametrize("text", ["[rows, cols]", "[contacts, 3]", "[samples + 1, 3]", "[rows]"])
def test_shapes_are_told_from_units(text):
    assert SHAPE.search(text)
    assert not UNIT.search(text)


NAMING = '''"""A record."""
RIG = (f"{__name__}.simulation:Simulation", "small.other:report", f"{__name__}.studies.{1}", "another.small.x")
'''


def test_a_closure_follows_imports_and_names_in_texts(tmp_path):
    files = {
        "__init__": "", "rig/__init__": NAMING, "rig/simulation": "from small.kernel import step", "kernel": "", "other": "",
        "unused": "", "rig/studies": "",
    }  # fmt: skip
    for name, text in files.items():
        path = tmp_path / "small" / f"{name}.py"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    found = modules(tmp_path / "small")
    assert closure(found, ["rig"], "small") == {"rig", "rig.simulation", "kernel", "other"}


def test_neighbours_that_import_each_other_are_found_where_one_is_a_folder():
    edges = {"a.b.c": {"a.d"}, "a.d": {"a.b.e"}, "a.b.e": {"a.f"}, "a.f": {"a.g"}, "a.g": {"a.f"}}
    assert folder_circles(edges) == [["a.b", "a.d"]]
