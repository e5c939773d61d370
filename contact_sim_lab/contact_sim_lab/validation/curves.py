"""Published curves beside those of the bench: judged by the share of their points inside, drawn, and listed on a page."""

from __future__ import annotations

import io
import math
import re
import textwrap
from collections.abc import Callable, Sequence
from itertools import groupby
from typing import Any, NamedTuple

from contact_sim_lab import cases
from contact_sim_pkg.records.published_curve import HELD, MEASURED, PublishedCurve, points_inside
from contact_sim_pkg.records.table import Section

__all__ = ["Judged", "all_curves", "as_rows", "judged", "page", "pictures", "sections", "study", "total"]

DOTS_PER_INCH = 110
WIDTH = 100


class Judged(NamedTuple):
    """A published curve with what the bench has at its places."""

    curve: PublishedCurve
    ours: tuple[float, ...]
    inside: tuple[bool | None, ...]
    """a point; None without a value of the bench"""

    @property
    def valued(self) -> list[bool]:
        """Of the points at which the bench has a value."""
        return [each for each in self.inside if each is not None]

    @property
    def holds(self) -> bool | None:
        """Whether the share of points inside is at least `HELD`; None without a value."""
        return sum(self.valued) >= HELD * len(self.valued) if self.valued else None

    @property
    def extremes(self) -> tuple[float, float]:
        """Smallest and largest relative difference of ours to the published values; nan without any."""
        found = [
            ours / y - 1.0 for ours, y in zip(self.ours, self.curve.y, strict=True) if math.isfinite(ours) and y != 0.0
        ]
        return min(found, default=math.nan), max(found, default=math.nan)


def all_curves() -> list[PublishedCurve]:
    """Every curve that the rigs name."""
    return cases.objects(cases.modules_of_rigs("curves"), "CURVES")


def judged(curve: PublishedCurve) -> Judged:
    """The curve with the bench's values."""
    assert curve.ours is not None
    ours = tuple(float(each) for each in curve.ours(curve.x))
    return Judged(curve, ours, tuple(points_inside(curve, ours)))


def study(progress: Callable[[str], None] | None = None) -> list[Judged]:
    """All curves, judged."""
    found = []
    for picture, curves in groupby(all_curves(), lambda each: each.picture):
        if progress is not None:
            progress(f"curves: {picture}")
        found += [judged(each) for each in curves]
    return found


def as_rows(found: Sequence[Judged]) -> list[dict[str, Any]]:
    """Flat rows for a script, a curve each."""
    return [
        {
            "picture": each.curve.picture, "quantity": each.curve.up, "over": each.curve.across, "curve": each.curve.name,
            "kind": each.curve.kind, "blind": each.curve.blind, "x": list(each.curve.x), "published": list(each.curve.y),
            "uncertainty": list(each.curve.error), "own_uncertainty": each.curve.own, "ours": list(each.ours),
            "points_inside": list(each.inside), "holds": each.holds, "source": each.curve.source, "note": each.curve.note,
        }
        for each in found
    ]  # fmt: skip


def total(found: Sequence[Judged]) -> str:
    """How many curves hold, and how many points lie inside."""
    measured = [each for each in found if each.curve.kind == MEASURED]
    blind = [each for each in found if each.curve.blind]
    alone = sum(
        abs(ours - y) <= error
        for each in found for ours, y, error in zip(each.ours, each.curve.y, each.curve.error, strict=True)
    )  # fmt: skip
    return (
        f"{sum(each.holds is True for each in found)} of {len(found)} curves hold; {_points(found)} points lie inside, of the "
        f"measured ones {_points(measured)}, of those of blind curves {_points(blind)}; {alone} by the published uncertainty alone"
    )


def sections(found: Sequence[Judged]) -> list[Section]:
    """As a person reads them: a section a picture, a row a pair of axes; and the total."""
    listed = [
        Section(picture, [_line(own) for own in _panels(group)], "") for picture, group in _by_picture(found).items()
    ]
    if listed:
        listed[-1] = listed[-1]._replace(note=total(found))
    return listed


def pictures(found: Sequence[Judged]) -> dict[str, bytes]:
    """A PNG for each picture, by the name of its file."""
    from contact_sim_pkg.report.drawing import style
    from contact_sim_pkg.report.figures.published import published_figure
    from contact_sim_pkg.report.printed import save_figure

    drawn = {}
    for picture, group in _by_picture(found).items():
        buffer = io.BytesIO()
        with style():
            figure = published_figure([each.curve for each in group], [each.ours for each in group])
        save_figure(buffer, figure, "png", DOTS_PER_INCH)
        drawn[_file(picture)] = buffer.getvalue()
    return drawn


def page(found: Sequence[Judged], folder: str, head: str = "") -> str:
    """The part of the page on the curves: the total, a ``head`` in words, then a part a picture, which lies in a ``folder``
    beside the page.
    """
    parts = [_paragraph(f"**{total(found)}.**"), head]
    for picture, group in _by_picture(found).items():
        parts += [
            f"## {picture}",
            "",
            f"![{picture}]({folder}/{_file(picture)})",
            "",
        ]
        lines = [_line(own) for own in _panels(group)]
        parts += [f"| {' | '.join(lines[0])} |", f"|{'---|' * len(lines[0])}"]
        parts += [f"| {' | '.join(line.values())} |" for line in lines]
        remarks = [_remark(own) for own in _panels(group)]
        parts += ["", *(_paragraph(each, "* ") for each in remarks if each)]
        parts += [""] if any(remarks) else []
        sources = dict.fromkeys(each.curve.source for each in group)
        parts += [*(_paragraph(f"Source: {each}.", "") for each in sources), ""]
    return "\n".join(parts)


def _by_picture(found: Sequence[Judged]) -> dict[str, list[Judged]]:
    groups: dict[str, list[Judged]] = {}
    for each in found:
        groups.setdefault(each.curve.picture, []).append(each)
    return groups


def _panels(group: Sequence[Judged]) -> list[list[Judged]]:
    """Curves that share their axes, as `report.figures.published.panels_of`."""
    return [list(own) for _axes, own in groupby(group, lambda each: (each.curve.across, each.curve.up))]


def _line(own: Sequence[Judged]) -> dict[str, str]:
    """What a pair of axes shows."""
    low, high = min(each.extremes[0] for each in own), max(each.extremes[1] for each in own)
    held = f"{sum(each.holds is True for each in own)} of {len(own)}"
    blind, fitted = ([each for each in own if each.curve.blind is wanted] for wanted in (True, False))
    return {
        "quantity": _quantity(own[0]), "kind": own[0].curve.kind, "blind": _names(blind), "fitted": _names(fitted),
        "difference": f"{100 * low:+.0f} to {100 * high:+.0f} %", "points inside": _points(own),
        "curves hold": held if all(each.holds for each in own) else f"**{held}**",
    }  # fmt: skip


def _remark(own: Sequence[Judged]) -> str:
    """What is remarked of the curves of a pair of axes, those that miss first named."""
    missed = [each for each in own if each.holds is not True]
    note = next((each.curve.note for each in (*missed, *own) if each.curve.note), "")
    if missed:
        return f"{_quantity(own[0])}, {_names(missed)}: {note or 'no reason is known'}"
    return f"{_quantity(own[0])}: {note}" if note else ""


def _names(own: Sequence[Judged]) -> str:
    """`166, 186 kPa`"""
    first, units = [], set()
    for each in own:
        number, _, unit = each.curve.name.rpartition(" ")
        first.append(number)
        units.add(unit)
    together = len(units) == 1 and all(each and each[0].isdigit() for each in first)
    return f"{', '.join(first)} {units.pop()}" if together else ", ".join(each.curve.name for each in own)


def _quantity(each: Judged) -> str:
    return f"{each.curve.up} over {each.curve.across.partition(',')[0]}"


def _points(found: Sequence[Judged]) -> str:
    return f"{sum(sum(each.valued) for each in found)} of {sum(len(each.valued) for each in found)}"


def _file(picture: str) -> str:
    return f"{re.sub('[^a-z0-9]+', '-', picture.lower()).strip('-')}.png"


def _paragraph(text: str, mark: str = "") -> str:
    return textwrap.fill(
        text,
        WIDTH,
        initial_indent=mark,
        subsequent_indent=" " * len(mark),
        break_long_words=False,
        break_on_hyphens=False,
    )
