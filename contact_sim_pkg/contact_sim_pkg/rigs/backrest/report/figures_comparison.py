"""Figure 3 of several runs: contact points on the contact domain at first touch and at the largest
force, run beside run.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from matplotlib.figure import Figure

from contact_sim_pkg.report.comparison.figures import Run
from contact_sim_pkg.report.drawing import MULTIPLES, PRESSURE_COLOURS, WIDTH, Picture, new_figure, picture
from contact_sim_pkg.report.figures.maps import Window, common_window
from contact_sim_pkg.report.point_series import PointSnapshot
from contact_sim_pkg.report.series import Snapshot
from contact_sim_pkg.rigs.backrest.report.figures_domain import AT_BACKREST, draw_domain, fit_of, highest_kilopascals

COLUMNS = 4
"""Most runs side by side."""


class _Domain(NamedTuple):
    """One run: its field and its points, at first touch and at the largest force."""

    run: Run
    fields: tuple[Snapshot, Snapshot]
    points: tuple[PointSnapshot | None, PointSnapshot | None]


def comparison_pictures(key: str, name: str, runs: list[Run]) -> list[Picture]:
    """Contact domain of every run; none where no run has fields and points of this contact."""
    found = domain_comparison(key, name, runs)
    return [] if found is None else [found]


def domain_comparison(key: str, name: str, runs: list[Run]) -> Picture | None:
    """One column for each run, first touch above largest force; None where no run has fields and
    points of this contact.
    """
    found = [each for run in runs if (each := _domain(run, name)) is not None]
    if not found:
        return None
    window = common_window([shown.field for each in found for shown in each.fields])
    columns = min(COLUMNS, len(found))
    rows = 2 * -(-len(found) // columns)
    height = float(np.clip(0.35 + window.aspect * 0.8 * WIDTH / columns, 1.2, 3.2))
    figure, axes = new_figure(
        rows * height + 0.7, rows, columns, MULTIPLES._replace(top=0.52), sharex=True, sharey=True
    )
    # Rows in pairs: first touch above largest force, for each run.
    panels = np.array(axes, dtype=object).reshape(rows // 2, 2, columns)
    for unused in panels.transpose(0, 2, 1).reshape(-1, 2)[len(found) :].flat:
        unused.set_axis_off()
    for stage in (0, 1):
        _draw_stage(figure, panels[:, stage].ravel().tolist(), found, stage, window)
    figure.supxlabel(AT_BACKREST.across)
    figure.supylabel(AT_BACKREST.along, x=0.004)
    return picture(
        f"{key}-domains", figure, f"Contact points on the contact domain of the {name} in every run", _caption(found)
    )


def _draw_stage(figure: Figure, places: list[Axes], found: list[_Domain], stage: int, window: Window) -> None:
    """First touch (0) or largest force (1) of every run, under one colour scale."""
    limits = Normalize(0.0, highest_kilopascals([each.fields[stage].field for each in found]))
    for place, each in zip(places, found, strict=False):
        shown = each.fields[stage]
        draw_domain(place, shown.field, each.points[stage], window, limits)
        called = f"{each.run.label}\n" if stage == 0 else ""
        place.set_title(f"{called}{shown.time:.3f} s, {shown.load:.4g} N")
    bar = figure.colorbar(ScalarMappable(limits, PRESSURE_COLOURS), ax=places, label="kPa", pad=0.01, aspect=14)
    bar.ax.spines["outline"].set_visible(False)


def _domain(run: Run, name: str) -> _Domain | None:
    field, points = run.recording.fields.get(name), run.recording.points
    if field is None or points is None:
        return None
    return _Domain(run, (field.touch or field.first, field.heaviest), (points.touch, points.heaviest))


def _caption(found: list[_Domain]) -> str:
    many = any(points is not None and points.x.size > 1 for each in found for points in each.points)
    dots = ", dots: the points that carry" if many else ""
    parts = [f"{each.run.label}: {_axes_of(each)}" for each in found]
    return (
        "Above at first touch (the start, where contact is kept), below at the largest force; one colour scale for each. Black: "
        f"the edge of the cells under pressure, red: the Lamé curve |x/a|ⁿ + |y/b|ⁿ = 1 through it{dots}. At the largest force "
        f"a (up), b (across) and n are {'; '.join(parts)}. {AT_BACKREST.seen}"
    )


def _axes_of(each: _Domain) -> str:
    heaviest = each.fields[1].field
    if not heaviest.pressure.any():
        return "no contact"
    fit = fit_of(heaviest)
    shape = f"{fit.a * 1e3:.3g} mm, {fit.b * 1e3:.3g} mm"
    return f"{shape}, {fit.exponent:.3g}" if fit.fitted else f"{shape} (not fitted)"
