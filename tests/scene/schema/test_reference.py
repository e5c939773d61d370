"""docs/scenes.md says what the schema says."""

from pathlib import Path

import pytest

from contact_sim_lab.pages.scene_reference import reference, with_tables
from contact_sim_pkg.scene.schema.catalog import catalog

DOCUMENT = Path(__file__).resolve().parents[3] / "docs" / "scenes.md"


def test_the_tables_of_the_document_are_those_of_the_schema():
    text = DOCUMENT.read_text(encoding="utf-8")
    assert with_tables(text) == text, "run: python -m contact_sim_lab.pages.scene_reference docs/scenes.md"


def test_every_key_stands_in_the_tables():
    rows = reference().count("\n| `")
    assert rows >= sum(location[-1] != "kind" for location in catalog())


def row_of(effect):
    """Needs and excludes of an effect in the table of those that go together."""
    (row,) = [line for line in reference().splitlines() if line.startswith(f"| `{effect}` |") and line.count("|") == 5]
    return tuple(cell.strip() for cell in row.split("|")[3:5])


@pytest.mark.parametrize(
    ("effect", "needs"),
    [
        ("foam_hysteresis", "normal_elastic or cushion"),
        ("friction", "normal_elastic or cushion"),
        ("rigid_ring", "normal_elastic or inflation"),
        ("contact_field", "normal_elastic or inflation (tire), cushion (seat)"),
        ("foam", "normal_elastic"),  # excludes the cushion
        ("shell_modes", "normal_elastic"),  # the cushion excludes it
        ("shift", "normal_elastic"),  # the impact has no other
        ("brush", "contact_field"),
    ],
)
def test_an_effect_needs_any_that_carries_the_load_and_stands_beside_it(effect, needs):
    assert row_of(effect)[0] == needs


@pytest.mark.parametrize(
    ("effect", "excludes"),
    [
        ("normal_elastic", "inflation (tire), cushion (seat, backrest)"),
        ("cushion", "normal_elastic, foam, half_space_field (seat), shell_modes (backrest)"),
        ("envelopment", "inflation"),
        ("friction", ""),
    ],
)
def test_effects_exclude_each_other_whichever_of_the_two_says_so(effect, excludes):
    assert row_of(effect)[1] == excludes


def test_a_document_without_marks_is_refused():
    with pytest.raises(ValueError, match="needs the lines"):
        with_tables("# Scenes\n")
