"""Published figures beside those of the bench."""

from pathlib import Path

import pytest

from contact_sim_lab.validation import validation
from contact_sim_pkg.records.metric import Published

INSIDE = Published(
    machine="scale", quantity="weight of 1 kg", unit="N", value="9.81 ± 0.01", band=(9.80, 9.82), source="a book, 1901",
    ours=lambda: 9.80665, fitted=True,
)  # fmt: skip
OUTSIDE = Published(
    machine="clock", quantity="period", unit="s", value="2", band=(1.9, 2.1), source="another, 1673", ours=lambda: 2.5,
    note="the pendulum is too long",
)  # fmt: skip


PAGE = Path(__file__).parents[2] / "docs" / "validation.md"


def test_the_page_in_the_project_has_every_published_figure():
    """`bench validation --page docs/validation.md --overwrite` makes it anew."""
    page = PAGE.read_text(encoding="utf-8")
    published = validation.all_published()
    assert len(published) >= 10
    for each in published:
        assert f"| {each.quantity} | {each.unit} | {each.value} |" in page


def test_what_leaves_its_band_on_the_page_says_why():
    page = PAGE.read_text(encoding="utf-8")
    remarks = " ".join(page.split())
    outside = [line.split(" | ")[0].removeprefix("| ") for line in page.splitlines() if "**outside**" in line]
    assert outside
    assert [quantity for quantity in outside if f"* {quantity}: " not in remarks] == []


@pytest.fixture
def _two(monkeypatch):
    monkeypatch.setattr(validation, "all_published", lambda: [INSIDE, OUTSIDE])


@pytest.mark.usefixtures("_two")
def test_a_row_holds_both_figures_and_whether_they_agree():
    rows = validation.study()
    assert [(row["ours"], row["inside"]) for row in rows] == [(9.80665, True), (2.5, False)]
    assert [section.note for section in validation.sections(rows)] == [
        "1 of 1 inside their band",
        "0 of 1 inside their band",
    ]


@pytest.mark.usefixtures("_two")
def test_the_page_gives_band_verdict_reason_and_source():
    page = validation.page(validation.study())
    assert "| weight of 1 kg | N | 9.81 ± 0.01 | 9.81 | 9.8 to 9.82 | inside, fitted | [1](#sources-scale) |" in page
    assert "| period | s | 2 | 2.5 | 1.9 to 2.1 | **outside** | [1](#sources-clock) |" in page
    assert "* period: the pendulum is too long" in page
    assert "### Sources: clock\n\n1. another, 1673" in page
