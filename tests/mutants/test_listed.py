"""The list of mutants stays true while files move."""

from pathlib import Path

import pytest
from tests.mutants.energies import ENERGIES
from tests.mutants.listed import MUTANTS
from tests.mutants.outputs import OUTPUTS
from tests.mutants.papers import PAPERS
from tests.mutants.source import file_of, mutated, noticing

ROOT = Path(__file__).resolve().parents[2]


@pytest.mark.parametrize(
    "mutant", [*MUTANTS, *ENERGIES, *OUTPUTS, *PAPERS], ids=lambda each: f"{each.function}: {each.text}"
)
def test_each_mutant_changes_one_function_in_one_place_and_names_its_tests(mutant):
    source = file_of(mutant, ROOT).read_text()
    changed = mutated(mutant, source)
    compile(changed, mutant.function, "exec")
    assert changed != source
    assert noticing(mutant, ROOT / "tests")
