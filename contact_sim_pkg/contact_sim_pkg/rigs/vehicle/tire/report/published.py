"""The published curves of a tire beside a run of one like it: deflection and length of the footprint over load."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from contact_sim_pkg.records.messages import TireStanding
from contact_sim_pkg.records.published_curve import PublishedCurve, curves_of
from contact_sim_pkg.report.drawing import ACCENT, INK, MUTED, Picture, new_figure, picture
from contact_sim_pkg.report.figures.published import MARGINS, PANEL, draw_panel
from contact_sim_pkg.report.page import PUBLISHED, Section
from contact_sim_pkg.report.rows import number
from contact_sim_pkg.report.series import FieldSeries, Recording
from contact_sim_pkg.rigs.vehicle.tire.published_tables import FORMULA_ERROR, OWN, PRINT_ERROR, published_tire
from contact_sim_pkg.rigs.vehicle.tire.report.metrics import one_obstacle
from contact_sim_pkg.rigs.vehicle.tire.report.numbers import TIRE
from contact_sim_pkg.rigs.vehicle.tire.report.standing_series import standing_of
from contact_sim_pkg.rigs.vehicle.tire.schema import Inflation
from contact_sim_pkg.rigs.vehicle.tire.size import read_size

__all__ = ["near_curves", "published_section"]

NEAR = 0.05  # of the inflation
MOST_FIELDS = 300
DRAWN = ("deflection", "length")
MEASURED_TIRE = "255/40 R17"


def published_section(recording: Recording) -> Section | None:
    """None where no published curve is of a tire, an inflation and loads like those of the run. Call inside
    `drawing.style()`.
    """
    standing = standing_of(recording)
    curves = near_curves(recording.scene)
    if standing is None or not curves or not all(curve.x[0] <= standing.load <= curve.x[-1] for curve in curves):
        return None
    # An obstacle is no plate; a road that is uneven all along is one on average
    field = recording.fields.get(TIRE) if one_obstacle(recording.scene) is None else None
    return Section("published-tire", "Published curves", [_drawn(curves, standing, field)], part=PUBLISHED)


def near_curves(scene: Mapping[str, Any]) -> list[PublishedCurve]:
    """Published deflection and length over load of the scene's tire at the nearest inflation, at most 5 % from its own: of the
    default tire the 205/60 R15 that it was fitted to, of the size 255/40 R17 the measured one. Empty for any other.
    """
    given = ((scene.get("effects") or {}).get(TIRE) or {}).get("inflation") or {}
    if not given:
        return []
    usual = Inflation().model_dump(exclude_none=True, exclude={"pressure"})
    if all(given.get(key) == value for key, value in usual.items()) and given.get("radius") is None:
        table, errors = published_tire("205_60R15"), dict.fromkeys(DRAWN, FORMULA_ERROR)
    elif read_size(str(given["size"])) == read_size(MEASURED_TIRE):
        table, errors = published_tire("255_40R17"), PRINT_ERROR
    else:
        return []
    pressure = 1e-3 * float(given["pressure"])
    nearest = min({float(row["inflation"]) for row in table.rows}, key=lambda each: abs(each - pressure))
    if abs(nearest - pressure) > NEAR * pressure:
        return []
    return [
        curve
        for quantity in DRAWN
        for curve in curves_of(
            table, table.notes["tire"], quantity, "load", "inflation", error=errors[quantity], own=OWN[quantity],
            at={"inflation": nearest},
        )
    ]  # fmt: skip


def _drawn(curves: list[PublishedCurve], standing: TireStanding, field: FieldSeries | None) -> Picture:
    figure, axes = new_figure(PANEL + 0.3, 1, len(curves), MARGINS)
    said = []
    for place, curve, value in zip(axes, curves, (standing.deflection, standing.length), strict=True):
        draw_panel(place, [replace(curve, name=f"published, {curve.name}")])
        place.plot(curve.x, curve.y, color=MUTED, linewidth=0.7, linestyle=":", zorder=1.0)
        if field is not None and curve is curves[-1]:
            some = slice(None, None, max(1, len(field.load) // MOST_FIELDS))
            place.plot(field.load[some], 1e3 * field.length[some], ".", color=ACCENT, markersize=2.5, zorder=0.0,
                       label="fields of this run on its road")  # fmt: skip
        place.plot(
            [standing.load],
            [1e3 * value],
            "D",
            color=ACCENT,
            markeredgecolor=INK,
            markersize=5.0,
            label="this run, standing",
        )
        y, error = (float(np.interp(standing.load, curve.x, each)) for each in (curve.y, curve.error))
        name, unit = curve.up.split(", ")
        said.append(f"{name} {number(1e3 * value)} {unit}, published {number(y)} ± {number(error)} {unit}")
    figure.legend(*axes[-1].get_legend_handles_labels(), loc="upper center", ncols=3)
    first, source = curves[0], curves[0].source.partition(". Licence")[0]
    caption = (
        f"{first.picture}; {first.kind}, at {first.name}. Standing under {number(standing.load)} N: {'; '.join(said)}, linear "
        f"between the published points. Source: {source}."
    )
    return picture("published-tire", figure, "Published deflection and footprint over load beside this run", caption)
