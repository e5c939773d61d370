"""The list of mutants stays true while files move."""

from pathlib import Path

import pytest
from tests.mutants.listed import MUTANTS
from tests.mutants.source import file_of, modules_noticing, mutated

ROOT = Path(__file__).resolve().parents[2]
PACKAGE = ROOT / "contact_sim_pkg" / "contact_sim_pkg"


@pytest.mark.parametrize("mutant", MUTANTS, ids=lambda each: f"{each.function}: {each.text}")
def test_each_mutant_changes_one_function_in_one_place_and_names_its_tests(mutant):
    source = file_of(mutant, PACKAGE).read_text()
    changed = mutated(mutant, source)
    compile(changed, mutant.function, "exec")
    assert changed != source
    assert modules_noticing(mutant, ROOT / "tests")
