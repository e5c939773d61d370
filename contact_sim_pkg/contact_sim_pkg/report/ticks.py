"""Tick labels of a figure that would stand on each other, by the widths that they have on the page."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import NamedTuple

from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.figure import Figure
from matplotlib.ticker import FixedLocator, MaxNLocator, ScalarFormatter

from contact_sim_pkg.report.rows import SUPERSCRIPT

__all__ = ["name_powers", "thin_labels"]

WIDTHS = {".": 0.32, ",": 0.32, "−": 0.84}
DIGIT = 0.64
"""Widths of letters over the font's size: those of a wide font, as the page may have another than the figure."""
BETWEEN = 0.3
"""Least gap between two labels, over the font's size."""
FEWER = (4, 3, 2, 1)
"""Intervals of an axis that are tried, until no labels meet."""


class _Label(NamedTuple):
    left: float
    right: float
    """[pt] from the figure's left"""


def thin_labels(figure: Figure) -> None:
    """Take fewer ticks along x where labels meet, of one axes or of two beside each other; in the end one in each."""
    rows: dict[int, list[Axes]] = {}
    for axes in figure.axes:
        if axes.name == "rectilinear" and isinstance(axes.xaxis.get_major_locator(), MaxNLocator):
            axes.apply_aspect()
            rows.setdefault(round(axes.get_position().y0 * figure.bbox.height), []).append(axes)
    for row in rows.values():
        for intervals in FEWER:
            if not _meeting(figure, row):
                break
            for axes in row:
                axes.xaxis.set_major_locator(MaxNLocator(intervals, min_n_ticks=1, prune="both"))
        if _meeting(figure, row):
            for axes in row:
                low, high = sorted(axes.get_xlim())
                middle = min(_inside(axes), key=lambda place: abs(place - 0.5 * (low + high)))
                axes.xaxis.set_major_locator(FixedLocator([middle]))


def name_powers(axis: Axis) -> None:
    """Put a power of ten that all tick labels of an axis lack into its label, where it stands on nothing."""
    formatter = axis.get_major_formatter()
    if not isinstance(formatter, ScalarFormatter) or not axis.get_label_text():
        return
    formatter.set_locs([*axis.get_majorticklocs()])
    if power := formatter.orderOfMagnitude:
        name, comma, unit = axis.get_label_text().rpartition(", ")
        factor = f"10{str(power).translate(SUPERSCRIPT)}"
        axis.set_label_text(f"{name}, {factor} {unit}" if comma else f"{unit}, {factor}")
        axis.offsetText.set_visible(False)


def _meeting(figure: Figure, row: Sequence[Axes]) -> bool:
    """Whether two labels below axes of one row meet."""
    labels = sorted(label for axes in row for label in _labels(figure, axes))
    return any(one.right > other.left for one, other in pairwise(labels))


def _labels(figure: Figure, axes: Axes) -> list[_Label]:
    ticks = axes.xaxis.get_major_ticks(1)
    if not axes.xaxis.get_visible() or not ticks[0].label1.get_visible():
        return []
    size, places = ticks[0].label1.get_fontproperties().get_size_in_points(), _inside(axes)
    found = []
    for place, text in zip(places, axes.xaxis.get_major_formatter().format_ticks(places), strict=True):
        if text:
            middle = axes.transData.transform((place, axes.get_ylim()[0]))[0] * 72.0 / figure.dpi
            half = 0.5 * size * (sum(WIDTHS.get(letter, DIGIT) for letter in text) + BETWEEN)
            found.append(_Label(middle - half, middle + half))
    return found


def _inside(axes: Axes) -> list[float]:
    """Places of ticks that are seen."""
    low, high = sorted(axes.get_xlim())
    slack = 1e-9 * (high - low)
    return [float(each) for each in axes.xaxis.get_majorticklocs() if low - slack <= each <= high + slack]
