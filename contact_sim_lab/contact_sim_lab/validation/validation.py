"""`bench validation`: published figures beside those of the bench."""

from __future__ import annotations

import textwrap
from collections.abc import Callable, Sequence
from typing import Any

from contact_sim_lab import cases
from contact_sim_lab.validation import curves
from contact_sim_lab.validation.curves import Judged
from contact_sim_pkg.records.metric import Published
from contact_sim_pkg.records.table import Section

__all__ = ["all_published", "page", "sections", "study"]

_COMMAND = "bench validation --page docs/validation.md --overwrite"

_WIDTH = 100
_HEAD = f"""# Validation

Published curves and figures of seats and tires beside those of the bench. Made, with its pictures,
by `{_COMMAND}`.
"""
_CURVES = """
A point is *inside* where the bench lies as near to it as both uncertainties together allow; a curve
*holds* where at least 70 % of its points do. *Measured*: points of a measurement; *formula*: values
of a formula that was fitted to measurements. *Fitted*: a constant of the bench was chosen by the
curve; all others are *blind*. Published: bars in the pictures; scatter of the points where none is
given, for a formula 5 % of a standing tire, 10 % of a rolling one; of people two standard
deviations. Ours: twice the standard deviation that `bench tire` fits with (deflection and stiffness
3.5 %, length, area and slip stiffness 6, width 14, trail 12 %), rolling resistance 10 %, a seat's
area and mean pressure 5, its peak 10 %.

In the pictures: round points measured, square ones of a formula, filled where fitted; lines of the
bench; a cross on what lies outside. *Difference*: from the smallest to the largest of (bench −
published)/published.

Not drawn: a truck tire 335/65 R22.5 at 4.8 and 6.5 bar (Project Chrono), for the inflation of a
scene ends at 4 bar; the thickness of tissue under the tuberosities, for the bench has no tissue;
rolling resistance over inflation of one small car, for its source is a forum.
"""
_FIGURES = """## Single figures

*Band*: values that agree with the publication, its scatter included. *Fitted*: a constant of the
bench was chosen by this figure; all others were not used. What leaves its band says why. *Usual
values* are ranges known in the trade that no publication was found to give: they tell a seat from
something else, and no more.
"""


def all_published() -> list[Published]:
    """Every published figure that the rigs name."""
    return cases.objects(cases.modules_of_rigs("validation"), "VALIDATION")


def study(progress: Callable[[str], None] | None = None) -> list[dict[str, Any]]:
    """Rows of all figures: machine, quantity, unit, published, ours, band [2], inside the band,
    fitted, source, note.
    """
    rows = []
    for each in all_published():
        if progress is not None:
            progress(f"{each.machine}: {each.quantity}")
        ours, (low, high) = float(each.ours()), each.band
        rows.append({
            "machine": each.machine, "quantity": each.quantity, "unit": each.unit, "published": each.value, "ours": ours,
            "band": [low, high], "inside": low <= ours <= high, "fitted": each.fitted, "source": each.source,
            "note": each.note,
        })  # fmt: skip
    return rows


def sections(rows: list[dict[str, Any]]) -> list[Section]:
    """The same rows as a person reads them: a section a machine."""
    found = []
    for machine in dict.fromkeys(row["machine"] for row in rows):
        own = [row for row in rows if row["machine"] == machine]
        inside = sum(row["inside"] for row in own)
        lines = [
            {
                "quantity": row["quantity"], "unit": row["unit"], "published": row["published"],
                "ours": _digits(row["ours"]), "band": _band(row), "inside": "yes" if row["inside"] else "NO",
                "fitted": "yes" if row["fitted"] else "",
            }
            for row in own
        ]  # fmt: skip
        found.append(Section(machine, lines, f"{inside} of {len(own)} inside their band"))
    return found


def page(rows: list[dict[str, Any]], found: Sequence[Judged] = (), folder: str = "validation") -> str:
    """The page `docs/validation.md`: the curves, their pictures in a ``folder``, then a table a machine with sources and
    remarks by number.
    """
    parts = [_HEAD]
    if found:
        parts += [curves.page(found, folder, _CURVES)]
    parts += [f"{_FIGURES}\n{sum(row['inside'] for row in rows)} of {len(rows)} lie inside their band.\n"]
    for machine in dict.fromkeys(row["machine"] for row in rows):
        own = [row for row in rows if row["machine"] == machine]
        parts.append(f"### {machine[0].upper()}{machine[1:]}\n")
        parts.append("| quantity | unit | published | bench | band | | source |\n|---|---|---|---|---|---|---|")
        sources = list(dict.fromkeys(row["source"] for row in own))
        for row in own:
            verdict = "inside" if row["inside"] else "**outside**"
            marks = f"{verdict}, fitted" if row["fitted"] else verdict
            number = sources.index(row["source"]) + 1
            parts.append(
                f"| {row['quantity']} | {row['unit']} | {row['published']} | {_digits(row['ours'])} | {_band(row)} | {marks} "
                f"| [{number}](#sources-{_anchor(machine)}) |"
            )
        remarks = [_item("* ", f"{row['quantity']}: {row['note']}") for row in own if row["note"]]
        if remarks:
            parts.append("\n" + "\n".join(remarks))
        parts.append(f"\n#### Sources: {machine}\n")
        parts.append("\n".join(_item(f"{number}. ", source) for number, source in enumerate(sources, 1)) + "\n")
    return "\n".join(parts).rstrip() + "\n"


def _item(mark: str, text: str) -> str:
    """An item of a list, in lines of `_WIDTH` characters."""
    return textwrap.fill(text, _WIDTH, initial_indent=mark, subsequent_indent=" " * len(mark))


def _anchor(heading: str) -> str:
    return heading.lower().replace(" ", "-")


def _digits(value: float) -> str:
    """Three significant digits, without exponent where there are few before the point."""
    return f"{float(f'{value:.3g}'):g}"


def _band(row: dict[str, Any]) -> str:
    low, high = row["band"]
    return f"{low:g} to {high:g}"
