"""Every run of the tests draws the same numbers: one profile of hypothesis for all, and no generator without a seed."""

import ast
import importlib
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.house.source import PACKAGE

TESTS = Path(__file__).resolve().parents[1]
OF_THE_PROFILE = {"derandomize", "deadline", "database"}
GENERATORS = {"default_rng", "Random", "RandomState", "SeedSequence", "PCG64", "Philox", "MT19937"}
same_draws = pytest.mark.skipif("config.getoption('random')", reason="draws anew")


def calls(path: Path, *words: str) -> list[ast.Call]:
    """The calls of a file that holds one of the words."""
    text = path.read_text()
    if not any(word in text for word in words):
        return []
    return [each for each in ast.walk(ast.parse(text)) if isinstance(each, ast.Call)]


def unseeded(path: Path) -> list[str]:
    """Calls of a file that draw from a generator without a seed."""
    # Elsewhere `random` is the name of a generator
    modules = {"numpy.random", "np.random"} | ({"random"} if "import random\n" in path.read_text() else set())
    found = []
    for call in calls(path, "random"):
        owner, _, name = ast.unparse(call.func).rpartition(".")
        shared = owner in modules and name.islower() and name != "default_rng"
        bare = name in GENERATORS and not call.args and not call.keywords
        turned = owner.endswith("Rotation") and name == "random" and not {"random_state", "rng"} & keywords(call)
        if shared or bare or turned or name == "urandom":
            found.append(f"{path.name}:{call.lineno}: {ast.unparse(call)}")
    return found


def keywords(call: ast.Call) -> set[str]:
    return {each.arg for each in call.keywords if each.arg}


def drawn() -> list[float]:
    found: list[float] = []

    @settings(max_examples=300)
    @given(st.floats(0.0, 1.0))
    def collect(number: float) -> None:
        found.append(number)

    collect()
    return found


@same_draws
def test_all_draw_by_one_profile():
    assert (settings.default.derandomize, settings.default.deadline, settings.default.database) == (True, None, None)
    files = [path for path in TESTS.rglob("*.py") if path != TESTS / "conftest.py"]
    own = [path.name for path in files for call in calls(path, *OF_THE_PROFILE) if OF_THE_PROFILE & keywords(call)]
    assert own == [], "what the profile in tests/conftest.py sets is set nowhere else"


@same_draws
def test_draws_do_not_change_with_what_was_imported_before(tmp_path, monkeypatch):
    before = drawn()
    (tmp_path / "imported_before.py").write_text("\n".join(f"x = {number / 997!r}" for number in range(997)))
    monkeypatch.syspath_prepend(tmp_path)
    importlib.import_module("imported_before")
    assert drawn() == before


def test_no_generator_is_without_a_seed():
    files = [*TESTS.rglob("*.py"), *PACKAGE.rglob("*.py")]
    assert [each for path in files for each in unseeded(path)] == []


def test_generators_without_a_seed_are_found(tmp_path):
    seeded = "random.Random(3)\nnumpy.random.default_rng(0).normal()\nRotation.random(rng=1)\n"
    bare = "random.random()\nrandom.Random()\nnumpy.random.normal(size=3)\nos.urandom(4)\ndefault_rng()\nRotation.random()\n"
    (tmp_path / "draws.py").write_text("import random\n" + seeded + bare)
    assert [each.split(":")[2].strip() for each in unseeded(tmp_path / "draws.py")] == bare.splitlines()
