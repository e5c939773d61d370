"""Drawing of published curves: points with their uncertainty, the bench's values as lines or points."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import groupby

import matplotlib
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from contact_sim_pkg.records.published_curve import MEASURED, PublishedCurve, points_inside
from contact_sim_pkg.report.drawing import INK, PRESSURE_COLOURS, Margins, new_figure

__all__ = ["draw_panel", "panels_of", "published_figure"]

MARGINS = Margins(left=0.62, right=0.12, top=0.62, across=0.62, down=0.82)
PANEL = 2.3
"""[inch] height of one, with its labels"""
BRIGHTEST = 0.8
"""Of the colour map: what is brighter is hard to see on white."""


def panels_of(curves: Sequence[PublishedCurve]) -> list[list[int]]:
    """Numbers of the curves that share their axes, in the order of the curves."""
    keys = [(each.across, each.up) for each in curves]
    return [list(places) for _key, places in groupby(range(len(curves)), keys.__getitem__)]


def published_figure(curves: Sequence[PublishedCurve], ours: Sequence[Sequence[float]]) -> Figure:
    """The curves of one picture, a panel for each pair of axes, with the values of the bench [curves][points] as lines.
    Call inside `drawing.style()`.
    """
    panels = panels_of(curves)
    cols = 2 if len(panels) == 4 else min(len(panels), 3)
    rows = math.ceil(len(panels) / cols)
    figure, axes = new_figure(PANEL * rows + 0.3, rows, cols, MARGINS)
    named: list[str] = []
    for place, panel in zip(axes, panels, strict=False):
        draw_panel(place, [curves[each] for each in panel], [ours[each] for each in panel])
        names = [curves[each].name for each in panel]
        # One legend above all panels whose curves have the same names
        if not named:
            named = names
            figure.legend(*place.get_legend_handles_labels(), loc="upper center", ncols=len(names), columnspacing=1.2)
        elif names != named and len(names) == 1:
            place.set_title(f"{curves[panel[0]].up}, {names[0]}", pad=4.0)
        elif names != named:
            place.legend(loc="best", handletextpad=0.2, borderaxespad=0.2, labelspacing=0.2)
    return figure


def draw_panel(axes: Axes, curves: Sequence[PublishedCurve], ours: Sequence[Sequence[float]] = ()) -> None:
    """Published points with their uncertainty, round where measured, square where of a formula, filled where the bench
    was fitted to them; lines of ours; a cross on a point that is not inside.
    """
    colours = matplotlib.colormaps[PRESSURE_COLOURS]
    for number, curve in enumerate(curves):
        colour = colours(BRIGHTEST * number / (len(curves) - 1)) if len(curves) > 1 else INK
        axes.errorbar(
            curve.x, curve.y, curve.error, color=colour, linestyle="none", marker="o" if curve.kind == MEASURED else "s",
            markersize=4.0, markerfacecolor="none" if curve.blind else colour, elinewidth=0.8, capsize=2.0, label=curve.name,
        )  # fmt: skip
        if number < len(ours):
            axes.plot(curve.x, ours[number], color=colour)
            missed = [each for each, inside in enumerate(points_inside(curve, ours[number])) if inside is False]
            axes.plot(
                [curve.x[each] for each in missed], [curve.y[each] for each in missed], "x", color=INK, markersize=6.5
            )
    axes.set_xlabel(curves[0].across)
    axes.set_title(curves[0].up, pad=4.0)
