"""docs/scenes.md says what the schema says."""

from pathlib import Path

import pytest

from contact_sim_pkg.scene.schema.catalog import catalog
from contact_sim_pkg.scene.schema.reference import reference, with_tables

DOCUMENT = Path(__file__).resolve().parents[3] / "docs" / "scenes.md"


def test_the_tables_of_the_document_are_those_of_the_schema():
    text = DOCUMENT.read_text(encoding="utf-8")
    assert with_tables(text) == text, "run: python -m contact_sim_pkg.scene.schema.reference docs/scenes.md"


def test_every_key_stands_in_the_tables():
    rows = reference().count("\n| `")
    assert rows >= sum(location[-1] != "kind" for location in catalog())


def test_a_document_without_marks_is_refused():
    with pytest.raises(ValueError, match="needs the lines"):
        with_tables("# Scenes\n")
